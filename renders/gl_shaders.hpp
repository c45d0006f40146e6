#pragma once

namespace drycut::renders::shaders {

// GLSL of the renderer. Colours are linear inside and get their gamma (2: a root is
// cheap) at the very end.

inline constexpr const char* kShown = R"(
vec3 shown(vec3 linear) { return sqrt(clamp(linear, 0.0, 1.0)); }
)";

/// How much of the key light reaches a point, 0..1. The taps are a loop of a length that depends on the pixel
/// because the rasteriser skips a loop, but not an `if`, where no pixel needs it.
inline constexpr const char* kShadow = R"(
uniform sampler2DShadow shadow_map;
uniform mat4 light_matrix;
float lit(vec3 world, float bias, bool wanted) {
  vec4 p = light_matrix * vec4(world, 1.0);
  vec3 at = p.xyz * 0.5 + 0.5;
  float edge = max(abs(p.x), abs(p.y));
  int taps = wanted && edge < 1.0 ? 2 : 0;
  float texel = 1.0 / float(textureSize(shadow_map, 0).x);
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) {
    vec2 offset = i == 0 ? vec2(-0.75, 0.25) * texel : vec2(0.75, -0.25) * texel;
    sum += texture(shadow_map, vec3(at.xy + offset, at.z - bias));
  }
  return taps == 0 ? 1.0 : mix(sum / 2.0, 1.0, smoothstep(0.85, 1.0, edge));
}
)";

inline constexpr const char* kSolidVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
layout(location = 3) in vec2 surface;
uniform mat4 matrix;
uniform mat4 model;
uniform mat3 turn;
out vec3 world;
out vec3 facing;
out vec3 paint;
out vec2 gloss;
void main() {
  world = (model * vec4(position, 1.0)).xyz;
  facing = turn * normal;
  paint = colour;
  gloss = surface;
  gl_Position = matrix * vec4(world, 1.0);
}
)";

inline constexpr const char* kSolidFragment = R"(
in vec3 world;
in vec3 facing;
in vec3 paint;
in vec2 gloss;
uniform vec3 eye;
uniform vec3 to_light;
out vec4 pixel;
// The hall as a shiny surface mirrors it: floor, wall, ceiling with a row of lamps.
vec3 surroundings(vec3 d) {
  vec3 floor_tone = vec3(0.20, 0.20, 0.21), wall = vec3(0.62, 0.66, 0.70), ceiling = vec3(0.95, 0.97, 1.0);
  vec3 tone = d.y < 0.0 ? mix(wall * 0.55, floor_tone, smoothstep(0.0, 0.5, -d.y))
                        : mix(wall, ceiling, smoothstep(0.0, 0.9, d.y));
  float lamps = smoothstep(0.50, 0.62, d.y) * (1.0 - smoothstep(0.72, 0.84, d.y));
  return tone + 0.9 * lamps;
}
void main() {
  vec3 n = normalize(facing);
  vec3 v = normalize(eye - world);
  vec3 base = paint * paint;
  float key = max(dot(n, to_light), 0.0);
  key *= lit(world, 0.0006 + 0.0022 * (1.0 - key), key > 0.0);
  float fill = max(dot(n, normalize(vec3(0.75, 0.25, 0.6))), 0.0);
  vec3 ambient = mix(vec3(0.17, 0.165, 0.16), vec3(0.42, 0.45, 0.49), n.y * 0.5 + 0.5);
  vec3 diffuse = base * (ambient + vec3(0.92, 0.89, 0.84) * key + vec3(0.15, 0.17, 0.20) * fill);
  float grazing = 1.0 - max(dot(n, v), 0.0);
  float fresnel = gloss.x + (1.0 - gloss.x) * 0.35 * grazing * grazing * grazing * grazing;
  vec3 mirrored = surroundings(reflect(-v, n)) * mix(vec3(1.0), base * 1.5, 0.6);
  float highlight = key > 0.0 ? pow(max(dot(n, normalize(v + to_light)), 0.0), gloss.y) : 0.0;
  vec3 seen = mix(diffuse, mirrored, fresnel) + vec3(1.0, 0.97, 0.92) * highlight * key * (0.04 + gloss.x);
  pixel = vec4(shown(seen), 1.0);
}
)";

/// A triangle that covers the picture, behind everything; `ray` goes from the eye through the pixel.
inline constexpr const char* kBackdropVertex = R"(
uniform vec3 forward, right, up;
out vec3 ray;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  ray = forward + corner.x * right + corner.y * up;
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";

/// Where the ray meets the floor, and how far from the middle in shares of the floor's reach.
inline constexpr const char* kFloorPoint = R"(
in vec3 ray;
uniform vec3 eye, centre;
uniform float reach;
out vec4 pixel;
vec3 floor_point() { return eye + ray * ((centre.y - eye.y) / (abs(ray.y) > 1e-6 ? ray.y : -1e-6)); }
float away(vec3 at) { return (centre.y - eye.y) * ray.y > 0.0 ? length(at - centre) / reach : 1.0; }
)";

/// Floor with its lines, fading into the background: the same for the whole film, drawn once.
inline constexpr const char* kBackdropFragment = R"(
uniform float spacing;
uniform float picture_height;
float lines(vec2 at, float width) {
  vec2 size = max(fwidth(at), vec2(1e-6));
  vec2 distance = abs(fract(at - 0.5) - 0.5);
  vec2 cover = clamp((0.5 * width - distance / size) + 0.5, 0.0, 1.0) * clamp(0.35 / size, 0.0, 1.0);
  return max(cover.x, cover.y);
}
vec3 background(float v) {
  vec3 low = vec3(0.60, 0.64, 0.68), horizon = vec3(0.80, 0.83, 0.86), high = vec3(0.33, 0.42, 0.53);
  return v < 0.55 ? mix(low, horizon, smoothstep(0.0, 0.55, v)) : mix(horizon, high, smoothstep(0.55, 1.15, v));
}
void main() {
  vec3 at = floor_point();
  vec2 square = at.xz / spacing;
  vec3 tone = vec3(0.56, 0.585, 0.61) * (1.0 - 0.16 * lines(square, 1.2) - 0.14 * lines(square / 5.0, 1.8));
  vec3 behind = background(gl_FragCoord.y / picture_height);
  pixel = vec4(shown(mix(tone, behind, smoothstep(0.25, 1.0, away(at)))), 1.0);
}
)";

/// The backdrop with the shadows of this frame.
inline constexpr const char* kShadowedFragment = R"(
uniform sampler2D backdrop;
void main() {
  vec3 at = floor_point();
  float far = away(at);
  float light = sqrt(mix(0.52, 1.0, lit(at, 0.0008, far < 1.0)));
  pixel = texelFetch(backdrop, ivec2(gl_FragCoord.xy), 0) * mix(light, 1.0, smoothstep(0.25, 1.0, far));
}
)";

/// Depth only, for the shadow map.
inline constexpr const char* kDepthVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 matrix;
uniform mat4 model;
void main() { gl_Position = matrix * (model * vec4(position, 1.0)); }
)";
inline constexpr const char* kDepthFragment = "void main() {}\n";

}  // namespace drycut::renders::shaders
