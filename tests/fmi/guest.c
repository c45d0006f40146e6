/* A small foreign FMU of either standard for the tests: a lag of the first order that counts its steps, and that
   can fail in every way. Compiled with -DFMI=2 or 3; -DLACKS_STEP leaves a function out, -DOTHER_VERSION lies about
   the standard, -DUNKNOWN knows one of its outputs not. */
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define JOINED_(a, b) a##b
#define JOINED(a, b) JOINED_(a, b)
#if FMI == 2
#define NAME(function) JOINED(fmi2, function)
typedef int flag;
typedef int32_t whole;
#else
#define NAME(function) JOINED(fmi3, function)
typedef bool flag;
typedef int64_t whole;
#endif
#define SHOWN __attribute__((visibility("default")))

enum { OK, WARNING, DISCARD, ERROR, FATAL };
enum { U, ENABLE, STEP_BY, GAIN, T, FAIL, FAIL_AT, LABEL, X, ON, COUNT, RPM, SPELT };
enum { CRASH = 1, HANG, EAT, REFUSE, LEAVE, NOT_A_NUMBER, REFUSE_BEGIN };

typedef struct {
  double u, gain, lag, fail_at, x;
  whole fail, step_by, count;
  flag enable;
  char label[256];
  void* environment;
#if FMI == 2
  void (*log)(void*, const char*, int, const char*, const char*, ...);
#else
  void (*log)(void*, int, const char*, const char*);
#endif
} Model;

static Model* made(void) {
  Model* m = calloc(1, sizeof(Model));
  m->gain = m->lag = 1;
  m->step_by = 1;
  strcpy(m->label, "plain");
  return m;
}

static int told(Model* m, const char* text) {
#if FMI == 2
  m->log(m->environment, "lag", ERROR, "logStatusError", "%s of %s", text, m->label);
#else
  m->log(m->environment, ERROR, "logStatusError", text);
#endif
  return ERROR;
}

SHOWN const char* NAME(GetVersion)(void) {
#ifdef OTHER_VERSION
  return "1.0";
#else
  return FMI == 2 ? "2.0" : "3.0";
#endif
}

#if FMI == 2
typedef struct {
  void (*log)(void*, const char*, int, const char*, const char*, ...);
  void *allocate, *release, *finished, *environment;
} Callbacks;
SHOWN void* fmi2Instantiate(const char* name, int type, const char* guid, const char* resources, const Callbacks* callbacks,
                            int visible, int logging) {
  if (type != 1 || strcmp(guid, "{lag}") != 0 || strncmp(resources, "file:///", 8) != 0) return NULL;
  Model* m = made();
  m->log = callbacks->log;
  m->environment = callbacks->environment;
  (void)name, (void)visible, (void)logging;
  return m;
}
SHOWN int fmi2SetupExperiment(void* c, int tolerant, double tolerance, double start, int ends, double stop) {
  (void)c, (void)tolerant, (void)tolerance, (void)ends, (void)stop;
  return start == 0 ? OK : ERROR;
}
SHOWN int fmi2EnterInitializationMode(void* c) {
  return ((Model*)c)->fail == REFUSE_BEGIN ? told(c, "will not begin") : OK;
}
#else
SHOWN void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, bool visible, bool logging,
                                        bool events, bool early, const uint32_t* needed, size_t count, void* environment,
                                        void (*log)(void*, int, const char*, const char*), void* update) {
  if (strcmp(token, "{lag}") != 0 || resources[0] != '/' || resources[strlen(resources) - 1] != '/') return NULL;
  Model* m = made();
  m->log = log;
  m->environment = environment;
  (void)name, (void)visible, (void)logging, (void)events, (void)early, (void)needed, (void)count, (void)update;
  return m;
}
SHOWN int fmi3EnterInitializationMode(void* c, bool tolerant, double tolerance, double start, bool ends, double stop) {
  (void)tolerant, (void)tolerance, (void)start, (void)ends, (void)stop;
  return ((Model*)c)->fail == REFUSE_BEGIN ? told(c, "will not begin") : OK;
}
#endif
SHOWN int NAME(ExitInitializationMode)(void* c) { return c ? OK : ERROR; }
SHOWN int NAME(Terminate)(void* c) { return c ? OK : ERROR; }
SHOWN void NAME(FreeInstance)(void* c) { free(c); }

static double* real_of(Model* m, uint32_t vr, double* scratch) {
  if (vr == U) return &m->u;
  if (vr == GAIN) return &m->gain;
  if (vr == T) return &m->lag;
  if (vr == FAIL_AT) return &m->fail_at;
  if (vr == X) return &m->x;
  *scratch = 60 * m->x;
#ifndef UNKNOWN
  if (vr == RPM) return scratch;
#endif
  return NULL;
}
static whole* whole_of(Model* m, uint32_t vr) {
  return vr == STEP_BY ? &m->step_by : vr == FAIL ? &m->fail : vr == COUNT ? &m->count : NULL;
}

#if FMI == 2
#define REST
#define REAL Real
#define WHOLE Integer
#else
#define REST , size_t values_size
#define REAL Float64
#define WHOLE Int64
#endif
#define ALL(type, where)                                      \
  (void)scratch;                                              \
  for (size_t n = 0; n < size; ++n) {                         \
    type* found = where;                                      \
    if (!found) return told(c, "no such variable");           \
    EXCHANGE;                                                 \
  }                                                           \
  return OK;
#define EXCHANGE values[n] = *found
SHOWN int NAME(JOINED(Get, REAL))(void* c, const uint32_t* vr, size_t size, double* values REST) {
  double scratch = 0;
  ALL(double, real_of(c, vr[n], &scratch))
}
SHOWN int NAME(JOINED(Get, WHOLE))(void* c, const uint32_t* vr, size_t size, whole* values REST) {
  int scratch = 0;
  ALL(whole, whole_of(c, vr[n]))
}
SHOWN int NAME(GetBoolean)(void* c, const uint32_t* vr, size_t size, flag* values REST) {
  for (size_t n = 0; n < size; ++n) values[n] = vr[n] == ON ? ((Model*)c)->x > 0.5 : ((Model*)c)->enable;
  return OK;
}
#undef EXCHANGE
#define EXCHANGE *found = values[n]
SHOWN int NAME(JOINED(Set, REAL))(void* c, const uint32_t* vr, size_t size, const double* values REST) {
  double scratch = 0;
  ALL(double, real_of(c, vr[n], &scratch))
}
SHOWN int NAME(JOINED(Set, WHOLE))(void* c, const uint32_t* vr, size_t size, const whole* values REST) {
  int scratch = 0;
  ALL(whole, whole_of(c, vr[n]))
}
SHOWN int NAME(SetBoolean)(void* c, const uint32_t* vr, size_t size, const flag* values REST) {
  for (size_t n = 0; n < size; ++n)
    if (vr[n] == ENABLE) ((Model*)c)->enable = values[n];
  return OK;
}
SHOWN int NAME(GetString)(void* c, const uint32_t* vr, size_t size, const char** values REST) {
  for (size_t n = 0; n < size; ++n) values[n] = ((Model*)c)->label;
  (void)vr;
  return OK;
}
SHOWN int NAME(SetString)(void* c, const uint32_t* vr, size_t size, const char* const* values REST) {
  if (size != 1 || vr[0] != LABEL) return ERROR;
  snprintf(((Model*)c)->label, sizeof ((Model*)c)->label, "%s", values[0]);
  return OK;
}

static int failed(Model* m, double at) {
  if (m->fail == 0 || at < m->fail_at) return OK;
  switch (m->fail) {
    case CRASH: raise_it: abort();
    case HANG:
      if (m->label[0] == '/') { /* a pipe, where the test waits for it */
        FILE* tells = fopen(m->label, "w");
        fprintf(tells, "%d", getpid());
        fclose(tells);
      }
      for (;;) pause();
    case EAT:
      for (;;) {
        char* more = malloc(1 << 20);
        if (!more) goto raise_it;
        memset(more, 1, 1 << 20);
      }
    case REFUSE: return told(m, "cannot go on");
    case LEAVE: _exit(7);
    case NOT_A_NUMBER: m->x = 0.0 / 0.0 + m->x; return OK;
    default: return OK;
  }
}

static int stepped(Model* m, double at, double size) {
  const int status = failed(m, at);
  if (status != OK) return status;
  if (m->enable) m->x += size / m->lag * (m->gain * m->u - m->x);
  m->count += m->step_by;
  return OK;
}

#ifndef LACKS_STEP
#if FMI == 2
SHOWN int fmi2DoStep(void* c, double at, double size, int no_state) {
  (void)no_state;
  return stepped(c, at, size);
}
#else
SHOWN int fmi3DoStep(void* c, double at, double size, bool no_state, bool* event, bool* end, bool* early, double* reached) {
  (void)no_state;
  *event = *end = *early = false;
  *reached = at + size;
  return stepped(c, at, size);
}
#endif
#endif

#if FMI == 2
#define STATE(verb) JOINED(fmi2, JOINED(verb, FMUstate))
#define SERIALIZED fmi2SerializedFMUstateSize
#define DESERIALIZE fmi2DeSerializeFMUstate
#else
#define STATE(verb) JOINED(fmi3, JOINED(verb, FMUState))
#define SERIALIZED fmi3SerializedFMUStateSize
#define DESERIALIZE fmi3DeserializeFMUState
#endif
/* What changes; where the log is, is of this process. */
typedef struct {
  double u, x;
  whole count;
  flag enable;
} Kept;
SHOWN int STATE(Get)(void* c, void** state) {
  const Model* m = c;
  if (!*state) *state = calloc(1, sizeof(Kept));
  *(Kept*)*state = (Kept){m->u, m->x, m->count, m->enable};
  return OK;
}
SHOWN int STATE(Set)(void* c, void* state) {
  Model* m = c;
  const Kept* kept = state;
  m->u = kept->u, m->x = kept->x, m->count = kept->count, m->enable = kept->enable;
  return OK;
}
SHOWN int STATE(Free)(void* c, void** state) {
  (void)c;
  free(*state);
  *state = NULL;
  return OK;
}
SHOWN int SERIALIZED(void* c, void* state, size_t* size) {
  (void)c, (void)state;
  *size = sizeof(Kept);
  return OK;
}
SHOWN int STATE(Serialize)(void* c, void* state, uint8_t* bytes, size_t size) {
  (void)c;
  if (size < sizeof(Kept)) return ERROR;
  memcpy(bytes, state, sizeof(Kept));
  return OK;
}
SHOWN int DESERIALIZE(void* c, const uint8_t* bytes, size_t size, void** state) {
  (void)c;
  if (size != sizeof(Kept)) return ERROR;
  if (!*state) *state = malloc(sizeof(Kept));
  memcpy(*state, bytes, sizeof(Kept));
  return OK;
}
