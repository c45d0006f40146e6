#include "renders/gl_program.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <stdexcept>

namespace drycut::renders {
namespace {

GLuint compile(GLenum kind, const std::string& source) {
  const std::string whole = "#version 330 core\n" + source;
  const char* text = whole.c_str();
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string log(2000, '\0');
  GLsizei size = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &size, log.data());
  log.resize(static_cast<std::size_t>(size));
  throw std::runtime_error("pictures: a shader does not compile: " + log);
}

}  // namespace

GlProgram::GlProgram(const std::string& vertex, const std::string& fragment) : program_(glCreateProgram()) {
  for (const GLuint shader : {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)}) {
    glAttachShader(program_, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program_);
  GLint good = GL_FALSE;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) throw std::runtime_error("pictures: the shaders do not fit together");
}

void GlProgram::use() const { glUseProgram(program_); }

int GlProgram::place(const char* name) const { return glGetUniformLocation(program_, name); }

void GlProgram::set(const char* name, const Matrix4& matrix) const {
  use();
  glUniformMatrix4fv(place(name), 1, GL_FALSE, Eigen::Matrix4f(matrix.cast<float>()).data());
}
void GlProgram::set(const char* name, const Vec3& vector) const {
  use();
  glUniform3fv(place(name), 1, as_floats(vector).data());
}
void GlProgram::set(const char* name, double value) const {
  use();
  glUniform1f(place(name), static_cast<float>(value));
}
void GlProgram::set(const char* name, double x, double y) const {
  use();
  glUniform2f(place(name), static_cast<float>(x), static_cast<float>(y));
}
void GlProgram::set_texture(const char* name, int unit) const {
  use();
  glUniform1i(place(name), unit);
}

}  // namespace drycut::renders
