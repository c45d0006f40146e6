/* A small importer of FMUs for co-simulation, 2.0 and 3.0: what a program needs to step one that lies unpacked in a folder.
   The standards' types and functions, as far as they are used, are declared here. */
#pragma once
#include <dlfcn.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*step_finished)(void*, int);
  void* environment;
} Callbacks2;

typedef struct {
  int version; /* 2 or 3 */
  char* description;
  void* library;
  void* instance;
  Callbacks2 callbacks;
} Fmu;

static inline void fail(const char* what, const char* which) {
  fprintf(stderr, "%s %s\n", what, which);
  exit(3);
}

static inline void log2_(void* environment, const char* name, int status, const char* category, const char* message, ...) {
  va_list rest;
  (void)environment, (void)status, (void)category;
  fprintf(stderr, "%s: ", name);
  va_start(rest, message);
  vfprintf(stderr, message, rest);
  va_end(rest);
  fputc('\n', stderr);
}
static inline void log3_(void* environment, int status, const char* category, const char* message) {
  (void)environment, (void)status, (void)category;
  fprintf(stderr, "fmu: %s\n", message);
}

/* The function fmi2NAME or fmi3NAME, cast where it is called. */
static inline void* function(const Fmu* fmu, const char* name) {
  char full[64];
  void* found;
  snprintf(full, sizeof full, "fmi%d%s", fmu->version, name);
  found = dlsym(fmu->library, full);
  if (found == NULL) fail("there is no function", full);
  return found;
}
static inline void check(int status, const char* what) {
  if (status > 1) fail("refused:", what);
}

/* The text of an attribute of the description's element, or of the first one that has it. */
static inline char* attribute(const char* description, const char* before) {
  const char* at = strstr(description, before);
  char* value;
  size_t size;
  if (at == NULL) fail("the description lacks", before);
  at += strlen(before);
  size = strcspn(at, "\"");
  value = calloc(size + 1, 1);
  memcpy(value, at, size);
  return value;
}
static inline uint32_t reference(const Fmu* fmu, const char* name) {
  char before[256];
  char* digits;
  uint32_t found;
  snprintf(before, sizeof before, " name=\"%s\" valueReference=\"", name);
  digits = attribute(fmu->description, before);
  found = (uint32_t)strtoul(digits, NULL, 10);
  free(digits);
  return found;
}

/* Loads the FMU in a folder and makes an instance, ready for parameters. */
static inline Fmu load_fmu(const char* folder) {
  Fmu fmu = {0};
  char path[4096];
  char* model;
  char* token;
  FILE* file;
  snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
  file = fopen(path, "rb");
  if (file == NULL) fail("there is no", path);
  fmu.description = calloc(16 << 20, 1);
  if (fread(fmu.description, 1, (16 << 20) - 1, file) == 0) fail("cannot read", path);
  fclose(file);
  fmu.version = strstr(fmu.description, "fmiVersion=\"2") != NULL ? 2 : 3;
  model = attribute(fmu.description, "modelIdentifier=\"");
  token = attribute(fmu.description, fmu.version == 2 ? "guid=\"" : "instantiationToken=\"");
  snprintf(path, sizeof path, "%s/binaries/%s/%s.so", folder, fmu.version == 2 ? "linux64" : "x86_64-linux", model);
  fmu.library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (fmu.library == NULL) fail("cannot load", dlerror());
  fmu.callbacks = (Callbacks2){log2_, calloc, free, NULL, NULL};
  if (fmu.version == 2) {
    snprintf(path, sizeof path, "file://%s/resources", folder);
    fmu.instance =
        ((void* (*)(const char*, int, const char*, const char*, const Callbacks2*, int, int))function(&fmu, "Instantiate"))(
            "machine", 1, token, path, &fmu.callbacks, 0, 0);
  } else {
    snprintf(path, sizeof path, "%s/resources/", folder);
    fmu.instance = ((void* (*)(const char*, const char*, const char*, bool, bool, bool, bool, const uint32_t*, size_t, void*,
                               void (*)(void*, int, const char*, const char*), void*))function(
        &fmu, "InstantiateCoSimulation"))("machine", token, path, false, false, false, false, NULL, 0, NULL, log3_, NULL);
  }
  if (fmu.instance == NULL) fail("no instance of", model);
  free(model);
  free(token);
  return fmu;
}

static inline void initialise(Fmu* fmu) {
  if (fmu->version == 2) {
    check(((int (*)(void*, int, double, double, int, double))function(fmu, "SetupExperiment"))(fmu->instance, 0, 0, 0, 0, 0),
          "the start");
    check(((int (*)(void*))function(fmu, "EnterInitializationMode"))(fmu->instance), "the initialisation");
  } else {
    check(((int (*)(void*, bool, double, double, bool, double))function(fmu, "EnterInitializationMode"))(fmu->instance, false, 0,
                                                                                                       0, false, 0),
          "the initialisation");
  }
  check(((int (*)(void*))function(fmu, "ExitInitializationMode"))(fmu->instance), "the initialisation");
}

static inline double get_real(const Fmu* fmu, uint32_t reference) {
  double value = 0;
  check(((int (*)(void*, const uint32_t*, size_t, double*, size_t))function(fmu, fmu->version == 2 ? "GetReal" : "GetFloat64"))(
            fmu->instance, &reference, 1, &value, 1),
        "a real output");
  return value;
}
static inline void set_real(const Fmu* fmu, uint32_t reference, double value) {
  check(((int (*)(void*, const uint32_t*, size_t, const double*, size_t))function(
            fmu, fmu->version == 2 ? "SetReal" : "SetFloat64"))(fmu->instance, &reference, 1, &value, 1),
        "a real input");
}
/* Counts have 64 bits, for which FMI 2.0 has a real number. */
static inline int64_t get_count(const Fmu* fmu, uint32_t reference) {
  int64_t value = 0;
  if (fmu->version == 2) return (int64_t)get_real(fmu, reference);
  check(((int (*)(void*, const uint32_t*, size_t, int64_t*, size_t))function(fmu, "GetInt64"))(fmu->instance, &reference, 1, &value,
                                                                                              1),
        "a count");
  return value;
}
static inline void set_count(const Fmu* fmu, uint32_t reference, int64_t value) {
  if (fmu->version == 2) {
    set_real(fmu, reference, (double)value);
    return;
  }
  check(((int (*)(void*, const uint32_t*, size_t, const int64_t*, size_t))function(fmu, "SetInt64"))(fmu->instance, &reference, 1,
                                                                                                    &value, 1),
        "a count");
}
/* A Boolean has 4 bytes in FMI 2.0 and one in 3.0. */
static inline bool get_switch(const Fmu* fmu, uint32_t reference) {
  int two = 0;
  bool three = false;
  void* value = fmu->version == 2 ? (void*)&two : (void*)&three;
  check(((int (*)(void*, const uint32_t*, size_t, void*, size_t))function(fmu, "GetBoolean"))(fmu->instance, &reference, 1, value, 1),
        "a switch");
  return two != 0 || three;
}
static inline void set_switch(const Fmu* fmu, uint32_t reference, bool on) {
  int two = on;
  const void* value = fmu->version == 2 ? (const void*)&two : (const void*)&on;
  check(((int (*)(void*, const uint32_t*, size_t, const void*, size_t))function(fmu, "SetBoolean"))(fmu->instance, &reference, 1,
                                                                                                   value, 1),
        "a switch");
}

static inline void do_step(const Fmu* fmu, double at, double size) {
  bool event = false;
  bool end = false;
  bool early = false;
  double reached = 0;
  if (fmu->version == 2)
    check(((int (*)(void*, double, double, int))function(fmu, "DoStep"))(fmu->instance, at, size, 1), "the step");
  else
    check(((int (*)(void*, double, double, bool, bool*, bool*, bool*, double*))function(fmu, "DoStep"))(
              fmu->instance, at, size, true, &event, &end, &early, &reached),
          "the step");
}

static inline void unload_fmu(Fmu* fmu) {
  ((void (*)(void*))function(fmu, "FreeInstance"))(fmu->instance);
  dlclose(fmu->library);
  free(fmu->description);
}
