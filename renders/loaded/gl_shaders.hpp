#pragma once

namespace drycut::renders::shaders {

// GLSL of the renderer. Colours are linear inside and get their gamma (2: a root is
// cheap) at the very end.

inline constexpr const char* kShown = R"(
vec3 shown(vec3 linear) { return sqrt(clamp(linear, 0.0, 1.0)); }
)";

/// What a part's surface is like, for every pixel that sees it; light comes later, once a pixel.
inline constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
layout(location = 3) in vec2 surface;
uniform mat4 matrix, model;
uniform mat3 turn;
uniform vec3 eye, forward;
out vec4 paint;
out vec4 facing;
void main() {
  vec4 world = model * vec4(position, 1.0);
  paint = vec4(colour, surface.x);
  facing = vec4(surface.y * normalize(turn * normal), dot(world.xyz - eye, forward));
  gl_Position = matrix * world;
}
)";
inline constexpr const char* kSurfaceFragment = R"(
in vec4 paint;
in vec4 facing;
layout(location = 0) out vec4 paint_reflection;  // colour, share mirrored
layout(location = 1) out vec4 normal_distance;   // normal as long as its gloss; metres ahead of the eye
void main() {
  paint_reflection = paint;
  normal_distance = facing;
}
)";

/// Depth only, for the map of what the key light reaches.
inline constexpr const char* kDepthVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 matrix, model;
void main() { gl_Position = matrix * (model * vec4(position, 1.0)); }
)";
inline constexpr const char* kDepthFragment = "void main() {}\n";

/// Height above the floor, and its square, as the sky sees it.
inline constexpr const char* kHeightVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 matrix, model;
uniform float floor_level;
out float height;
void main() {
  vec4 world = model * vec4(position, 1.0);
  height = world.y - floor_level;
  gl_Position = matrix * world;
}
)";
inline constexpr const char* kHeightFragment = R"(
in float height;
out vec2 moments;
void main() { moments = vec2(height, height * height); }
)";

/// A triangle that covers the picture.
inline constexpr const char* kWholeVertex = R"(
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 1.0, 1.0);
}
)";

/// Means of the heights over four by four texels around: every look reads the mean of four.
inline constexpr const char* kMeansFragment = R"(
uniform sampler2D heights;
uniform float shrink;
out vec2 moments;
void main() {
  vec2 texel = 1.0 / vec2(textureSize(heights, 0));
  vec2 at = gl_FragCoord.xy * shrink * texel;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < 4; ++i)
    sum += textureLod(heights, at + texel * vec2(i % 2 == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0), 0.0).rg;
  moments = 0.25 * sum;
}
)";

/// How much of the key light and of the sky's light reach a point, 0..1. The key's map is looked at whether
/// or not the point faces the lamp: the rasteriser pays more for the choice than for the look.
inline constexpr const char* kLamps = R"(
uniform sampler2DShadow key_map;
uniform mat4 key_matrix;
float lit(vec3 world, float bias) {
  vec4 p = key_matrix * vec4(world, 1.0);
  vec3 at = p.xyz * 0.5 + 0.5;
  float edge = max(abs(p.x), abs(p.y));
  float sum = textureLod(key_map, vec3(at.xy, at.z - bias), 0.0);
  return mix(sum, 1.0, smoothstep(0.85, 1.0, edge));
}

uniform sampler2D sky_map;
uniform float sky_reach;  // of the map from the centre
uniform float sky_blur;   // from mean to mean
// The share of what is around that stands higher, as mean and variance tell (Cantelli's inequality), weighed
// by how near above it is. A wall asks in front of itself.
float open_sky(vec3 world, vec3 n) {
  vec2 at = (world.xz + sky_blur * n.xz - centre.xz) / sky_reach;
  vec2 mean = textureLod(sky_map, vec2(at.x, -at.y) * 0.5 + 0.5, 0.0).rg;
  float above = max(mean.x - (world.y - centre.y), 0.0);
  float spread = max(mean.y - mean.x * mean.x, 0.0) + 1e-4 * sky_blur * sky_blur;
  float covered = above * above / (spread + above * above);
  float how_high = (spread + above * above) / max(above, 1e-6);
  return 1.0 - 0.9 * covered * mix(0.65, 1.0, sky_blur / (sky_blur + how_high));
}
)";

/// A patch, from the square of -1 to 1 to clip coordinates.
inline constexpr const char* kPatchVertex = R"(
uniform mat4 patch_matrix;
void main() {
  vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2) * 2.0 - 1.0;
  gl_Position = patch_matrix * vec4(corner, 0.0, 1.0);
}
)";

/// From the eye through the pixel, as long as one metre ahead is away.
inline constexpr const char* kRay = R"(
uniform vec3 centre;  // of the mechanism, on the floor
uniform vec3 eye, forward, right, up;
uniform vec2 pixel_size;
vec3 ray() {
  vec2 at = gl_FragCoord.xy * pixel_size - 1.0;
  return forward + at.x * right + at.y * up;
}
)";

inline constexpr const char* kPartsFragment = R"(
uniform sampler2D paints, normals;
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
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec4 paint = texelFetch(paints, place, 0);
  vec4 facing = texelFetch(normals, place, 0);
  vec3 ahead = facing.a * ray();
  vec3 world = eye + ahead;
  float gloss = length(facing.xyz);
  vec3 n = facing.xyz / gloss;
  vec3 v = -normalize(ahead);
  vec3 base = paint.rgb * paint.rgb;
  float reflection = paint.a;
  float sky = open_sky(world, n);
  float key = max(dot(n, to_light), 0.0);
  key *= lit(world, 0.0006 + 0.0022 * (1.0 - key)) * (0.6 + 0.4 * sky);
  float fill = max(dot(n, normalize(vec3(0.75, 0.25, 0.6))), 0.0);
  vec3 ambient = mix(vec3(0.17, 0.165, 0.16), vec3(0.42, 0.45, 0.49), n.y * 0.5 + 0.5);
  vec3 diffuse = base * (sky * (ambient + vec3(0.15, 0.17, 0.20) * fill) + vec3(0.92, 0.89, 0.84) * key);
  float grazing = 1.0 - max(dot(n, v), 0.0);
  float fresnel = reflection + (1.0 - reflection) * 0.35 * grazing * grazing * grazing * grazing;
  vec3 mirrored = sky * surroundings(reflect(-v, n)) * mix(vec3(1.0), base * 1.5, 0.6);
  float highlight = key > 0.0 ? pow(max(dot(n, normalize(v + to_light)), 0.0), gloss) : 0.0;
  vec3 seen = mix(diffuse, mirrored, fresnel) + vec3(1.0, 0.97, 0.92) * highlight * key * (0.04 + reflection);
  pixel = vec4(shown(seen), 1.0);
}
)";

/// Where the ray meets the floor, and how far from the middle in shares of the floor's reach.
inline constexpr const char* kFloorPoint = R"(
uniform float reach;
vec3 floor_point(vec3 ray) { return eye + ray * ((centre.y - eye.y) / (abs(ray.y) > 1e-6 ? ray.y : -1e-6)); }
float away(vec3 at, vec3 ray) { return (centre.y - eye.y) * ray.y > 0.0 ? length(at - centre) / reach : 1.0; }
)";

/// Floor with its lines, fading into the background, without shadows: the same until the camera moves.
inline constexpr const char* kHallFragment = R"(
uniform float spacing;
out vec4 pixel;
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
  vec3 through = ray();
  vec3 at = floor_point(through);
  vec2 square = at.xz / spacing;
  vec3 tone = vec3(0.56, 0.585, 0.61) * (1.0 - 0.16 * lines(square, 1.2) - 0.14 * lines(square / 5.0, 1.8));
  vec3 behind = background(0.5 * gl_FragCoord.y * pixel_size.y);
  pixel = vec4(shown(mix(tone, behind, smoothstep(0.25, 1.0, away(at, through)))), 1.0);
}
)";

inline constexpr const char* kFloorFragment = R"(
uniform sampler2D hall;
out vec4 pixel;
void main() {
  vec3 through = ray();
  vec3 at = floor_point(through);
  float far = away(at, through);
  float sky = open_sky(at, vec3(0.0, 1.0, 0.0));
  float light = 0.52 * sky + 0.48 * (0.6 + 0.4 * sky) * lit(at, 0.0008);
  pixel = texelFetch(hall, ivec2(gl_FragCoord.xy), 0) * mix(sqrt(light), 1.0, smoothstep(0.25, 1.0, far));
}
)";

}  // namespace drycut::renders::shaders
