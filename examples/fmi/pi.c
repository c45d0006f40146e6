/* Our machine under a controller of one's own: a rotary knife turns its drum to an angle by a PI position loop.
   cc pi.c -ldl -o pi; drycut fmu scenes/rotary_knife.yaml --out knife.fmu; unzip knife.fmu -d knife; ./pi "$PWD/knife" */
#include "importer.h"

int main(int argc, char** argv) {
  const double h = 1e-4;               /* the scene's step [s] */
  const int every = 20;                /* steps of a cycle of the controller: 2 ms */
  const double kp = 0.0015, ki = 0.01; /* [V/count], [V/count/s] */
  double sum = 0, volts = 0;
  if (argc != 2) fail("usage: pi", "FOLDER");
  Fmu knife = load_fmu(argv[1]);
  const uint32_t reference_volts = reference(&knife, "knife.servo.reference");
  const uint32_t encoder = reference(&knife, "knife.encoder");
  const uint32_t angle = reference(&knife, "knife.angle.total");
  set_real(&knife, reference(&knife, "parameters.web.speed"), 0); /* [m/s]: no web runs below the blade */
  initialise(&knife);
  for (int step = 0; step < 20000; ++step) {
    if (step % every == 0) { /* the native order: controller, inputs, step */
      const double error = (double)(4096 - get_count(&knife, encoder));
      sum += error * every * h;
      volts = kp * error + ki * sum;
      volts = volts > 10 ? 10 : volts < -10 ? -10 : volts;
      set_real(&knife, reference_volts, volts);
      if (step % 2000 == 0) printf("%.1f s: %.3f deg, %.3f V\n", step * h, get_real(&knife, angle), volts);
    }
    do_step(&knife, step * h, h);
  }
  printf("at rest: %lld counts\n", (long long)get_count(&knife, encoder));
  unload_fmu(&knife);
  return 0;
}
