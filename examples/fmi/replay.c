/* Drives the machine by a table of inputs, a row a step, and writes a table of outputs:
     replay FOLDER STEP INPUTS OUTPUTS NAME... < table > table
   INPUTS and OUTPUTS say how many names of each follow; a name is real:NAME, count:NAME or switch:NAME. */
#include "importer.h"

typedef struct {
  char kind; /* r, c, s */
  uint32_t reference;
} Signal;

static Signal signal_of(const Fmu* fmu, const char* text) {
  const char* colon = strchr(text, ':');
  if (colon == NULL) fail("no kind:", text);
  return (Signal){text[0], reference(fmu, colon + 1)};
}

static void set(const Fmu* fmu, Signal to, double value) {
  if (to.kind == 'c')
    set_count(fmu, to.reference, (int64_t)value);
  else if (to.kind == 's')
    set_switch(fmu, to.reference, value != 0);
  else
    set_real(fmu, to.reference, value);
}

static double get(const Fmu* fmu, Signal from) {
  if (from.kind == 'c') return (double)get_count(fmu, from.reference);
  return from.kind == 's' ? get_switch(fmu, from.reference) : get_real(fmu, from.reference);
}

int main(int argc, char** argv) {
  if (argc < 5) fail("usage: replay", "FOLDER STEP INPUTS OUTPUTS NAME...");
  Fmu fmu = load_fmu(argv[1]);
  const double h = strtod(argv[2], NULL);
  const int inputs = atoi(argv[3]), outputs = atoi(argv[4]);
  if (argc != 5 + inputs + outputs) fail("other names than", "INPUTS and OUTPUTS say");
  Signal* all = calloc((size_t)(inputs + outputs) + 1, sizeof *all);
  for (int n = 0; n < inputs + outputs; ++n) all[n] = signal_of(&fmu, argv[5 + n]);
  initialise(&fmu);
  for (long step = 0;; ++step) {
    double value = 0;
    for (int n = 0; n < inputs; ++n) {
      if (scanf("%lf", &value) != 1) {
        unload_fmu(&fmu);
        return 0;
      }
      set(&fmu, all[n], value);
    }
    do_step(&fmu, (double)step * h, h);
    for (int n = 0; n < outputs; ++n)
      printf("%s%.17g", n == 0 ? "" : " ", get(&fmu, all[inputs + n]));
    putchar('\n');
  }
}
