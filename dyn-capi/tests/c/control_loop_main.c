
/* Behind the blocks of docs/control-loop.md: a cycle at home, one that fails, and too many of them. */
#include <math.h>
#include <stdio.h>

int main(void)
{
    static const dyn_real at_rest[6] = { 0, 0, 0, 0, 0, 0 };
    const dyn_model model = { .struct_size = sizeof model, .kind = DYN_MODEL_KIND_BAKED };
    /* Tilted by 90 degrees about x: the weight lies along -y of the base. */
    base_measurement base = {
        .attitude = { (dyn_real)0.70710678118654752, (dyn_real)0.70710678118654752, 0, 0 },
        .specific_force = { 0, (dyn_real)9.81, 0 },
    };
    loop_state loop = {
        { { 0, 0, (dyn_real)0.38 }, { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, /* 2 mm below home: a cold start */
        { 0 },
        0,
    };
    /* Lengths at home; the rates of a platform that turns with the base. */
    dyn_real length[6];
    dyn_inputs inputs = { .struct_size = sizeof inputs };
    dyn_limits limits;
    dyn_real sum = 0, first;
    int i, failures = 0;

    for (i = 0; i < 6; i++) {
        length[i] = (dyn_real)0.198208444;
    }
    failures += !cycle(&loop, &model, &base, length, at_rest, at_rest);
    for (i = 0; i < 6; i++) {
        sum += loop.force[i];
    }
    /* No weight along the actuators: the springs alone, 26.96 N. */
    failures += !(fabs((double)sum - 26.96) < 0.01);
    first = loop.force[0];
    failures += !(fabs((double)loop.platform.position[2] - 0.382) < 1e-5);

    /* A sensor breaks: the old forces, for ten cycles. */
    base.angular_rate[1] = (dyn_real)NAN;
    for (i = 0; i < CYCLES_FORGIVEN; i++) {
        failures += !cycle(&loop, &model, &base, length, at_rest, at_rest) || loop.force[0] != first;
    }
    failures += cycle(&loop, &model, &base, length, at_rest, at_rest);

    /* Turning about the IMU's own axis from the base's origin adds w^2 r towards it, which must be taken off again. */
    base.angular_rate[1] = 0;
    base.angular_rate[2] = 2;
    base.specific_force[0] = -(dyn_real)0.4;
    failures += !cycle(&loop, &model, &base, length, at_rest, at_rest) || loop.bad_cycles != 0;
    failures += set_base(&inputs, &base, NULL) != DYN_STATUS_OK;
    for (i = 0; i < 3; i++) {
        failures += !(fabs((double)inputs.base_acceleration[i]) < 1e-5);
    }

    /* Within the limits of the platform file, until conditioning must be perfect. */
    failures += read_limits(&model, &limits, NULL) != DYN_STATUS_OK;
    failures += set_platform(&model, &inputs, &loop.platform, length, at_rest, NULL) != DYN_STATUS_OK;
    failures += dyn_check_limits(&model, &inputs, &limits, NULL) != DYN_STATUS_OK;
    limits.minimum_condition_bound = 1;
    failures += dyn_check_limits(&model, &inputs, &limits, NULL) != DYN_STATUS_BEYOND_LIMIT;
    printf("documented loop: %d failures\n", failures);
    return failures;
}
