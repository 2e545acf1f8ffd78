
/* Behind the blocks of docs/control-loop.md: a cycle at home, cycles that fail, too many of them, and a loop that is closed. */
#include <stdio.h>

/* Sensors of a base that swings by `angle` about a fixed axis through its origin, which is at rest. */
static base_measurement swinging(dyn_real angle, dyn_real rate, dyn_real acceleration)
{
    static const dyn_real axis[3] = { 0, (dyn_real)0.6, (dyn_real)0.8 };
    base_measurement measured = { .attitude = { (dyn_real)cos((double)angle / 2) } };
    dyn_real rotation[3][3], to_base[3][3], swing[3] = { 0, 0, 0 }, weight[3];
    int i;

    for (i = 0; i < 3; i++) {
        measured.attitude[1 + i] = axis[i] * (dyn_real)sin((double)angle / 2);
        measured.angular_rate[i] = axis[i] * rate;
        measured.angular_acceleration[i] = axis[i] * acceleration;
    }
    dyn_rotation_from_quaternion(measured.attitude, &rotation, NULL);
    transpose(to_base, rotation);
    turn(weight, to_base, gravity);
    add_cross(swing, 1, measured.angular_rate, imu_place);
    add_cross(measured.specific_force, 1, measured.angular_acceleration, imu_place);
    add_cross(measured.specific_force, 1, measured.angular_rate, swing);
    for (i = 0; i < 3; i++) {
        measured.specific_force[i] -= weight[i];
    }
    return measured;
}

/* How far from `wanted` a loop leaves a platform that starts beside it on a swinging base, m or rad, later than 0.25 s. */
static dyn_real closed_loop(const dyn_model *model, const dyn_limits *limits, const dyn_voice_coils *coils)
{
    const dyn_real step = (dyn_real)1e-4;
    relative_pose wanted = home;
    dyn_inputs plant = {
        .struct_size = sizeof plant,
        .platform_position = { (dyn_real)0.001, (dyn_real)-0.001, (dyn_real)0.381 },
        .platform_rotation = { { 1, (dyn_real)-0.01, 0 }, { (dyn_real)0.01, 1, 0 }, { 0, 0, 1 } },
    };
    loop_state loop;
    dyn_real error = 0;
    int tick, i, j;

    wanted.position[0] = (dyn_real)0.002;
    start(&loop);
    for (tick = 0; tick < 5000; tick++) {
        const double phase = 10 * (double)step * tick;
        const base_measurement base =
            swinging((dyn_real)(0.1 * sin(phase)), (dyn_real)cos(phase), (dyn_real)(-10 * sin(phase)));
        dyn_leg_kinematics_result legs = { .struct_size = sizeof legs };
        dyn_real acceleration[6], before[3][3], columns[3][3], square[3][3], cube[3][3];
        dyn_status status = set_base(&plant, &base, NULL);

        /* The nearest rotation to what was integrated: R (3 - R^T R)/2, twice. */
        for (j = 0; j < 2; j++) {
            transpose(before, plant.platform_rotation);
            multiply(square, before, plant.platform_rotation);
            multiply(cube, plant.platform_rotation, square);
            for (i = 0; i < 9; i++) {
                plant.platform_rotation[i / 3][i % 3] =
                    (3 * plant.platform_rotation[i / 3][i % 3] - cube[i / 3][i % 3]) / 2;
            }
        }
        if (status != DYN_STATUS_OK || dyn_leg_kinematics(model, &plant, &legs, NULL) != DYN_STATUS_OK
            || !cycle(&loop, model, limits, coils, wanted, &base, legs.actuator_length, legs.actuator_velocity)) {
            return (dyn_real)INFINITY;
        }
        for (i = 0; i < 6; i++) {
            plant.actuator_force[i] = loop.currents.actuator_force[i];
        }
        if (dyn_forward_dynamics(model, &plant, &acceleration, NULL) != DYN_STATUS_OK) {
            return (dyn_real)INFINITY;
        }
        for (i = 0; i < 6; i++) {
            plant.platform_velocity[i] += step * acceleration[i];
        }
        transpose(before, plant.platform_rotation);
        transpose(columns, plant.platform_rotation);
        for (i = 0; i < 3; i++) {
            plant.platform_position[i] += step * plant.platform_velocity[i];
            add_cross(columns[i], step, &plant.platform_velocity[3], before[i]);
        }
        transpose(plant.platform_rotation, columns);
        for (i = 0; tick >= 2500 && i < 9; i++) {
            error = (dyn_real)fmax(error, fabs(loop.platform.rotation[i / 3][i % 3] - wanted.rotation[i / 3][i % 3]));
            error = (dyn_real)fmax(error, fabs(loop.platform.position[i % 3] - wanted.position[i % 3]));
        }
    }
    return error;
}

int main(void)
{
    static const dyn_real at_rest[6] = { 0, 0, 0, 0, 0, 0 };
    const dyn_model model = { .struct_size = sizeof model, .kind = DYN_MODEL_KIND_BAKED };
    /* Tilted by 90 degrees about x: the weight lies along -y of the base. */
    base_measurement base = {
        .attitude = { (dyn_real)0.70710678118654752, (dyn_real)0.70710678118654752, 0, 0 },
        .specific_force = { 0, (dyn_real)9.81, 0 },
    };
    loop_state loop;
    /* Lengths at home; the rates of a platform that turns with the base. */
    dyn_real length[6];
    dyn_inputs inputs = { .struct_size = sizeof inputs };
    dyn_info info = { .struct_size = sizeof info };
    dyn_limits limits;
    dyn_voice_coils coils;
    dyn_real sum = 0, first, astray;
    int i, failures = 0;

    for (i = 0; i < 6; i++) {
        length[i] = (dyn_real)0.198208444;
    }
    failures += read_limits(&model, &limits, &coils, NULL) != DYN_STATUS_OK;
    start(&loop);
    failures += loop.currents.current[0] != 0;
    loop.platform.position[2] = (dyn_real)0.38; /* 2 mm below home: a cold start */
    failures += !cycle(&loop, &model, &limits, &coils, home, &base, length, at_rest);
    for (i = 0; i < 6; i++) {
        sum += loop.currents.actuator_force[i];
    }
    /* No weight along the actuators: the springs alone, 26.96 N. */
    failures += !(fabs((double)sum - 26.96) < 0.01);
    first = loop.currents.current[0];
    failures += !(fabs((double)loop.platform.position[2] - 0.382) < 1e-5);

    /* A sensor breaks: the old currents, for ten cycles. */
    base.angular_rate[1] = (dyn_real)NAN;
    for (i = 0; i < CYCLES_FORGIVEN; i++) {
        failures += !cycle(&loop, &model, &limits, &coils, home, &base, length, at_rest) || loop.currents.current[0] != first;
    }
    failures += cycle(&loop, &model, &limits, &coils, home, &base, length, at_rest);

    /* Turning about the IMU's own axis from the base's origin adds w^2 r towards it, which must be taken off again. */
    base.angular_rate[1] = 0;
    base.angular_rate[2] = 2;
    base.specific_force[0] = -(dyn_real)0.4;
    failures += !cycle(&loop, &model, &limits, &coils, home, &base, length, at_rest) || loop.bad_cycles != 0;
    failures += set_base(&inputs, &base, NULL) != DYN_STATUS_OK;
    for (i = 0; i < 3; i++) {
        failures += !(fabs((double)inputs.base_acceleration[i]) < 1e-5);
    }

    /* A length jumps within its stroke, then beyond it: not believed, and the old pose kept. */
    for (i = 0; i < 2; i++) {
        length[3] += (dyn_real)0.008;
        failures += !cycle(&loop, &model, &limits, &coils, home, &base, length, at_rest) || loop.bad_cycles != i + 1;
    }
    failures += check_lengths(&limits, length, at_rest, &info) != DYN_STATUS_BEYOND_LIMIT || info.leg != 3;
    failures += !(fabs((double)loop.platform.position[2] - 0.382) < 1e-5);
    length[3] = length[0];
    failures += !cycle(&loop, &model, &limits, &coils, home, &base, length, at_rest) || loop.bad_cycles != 0;

    /* Within the limits, until conditioning must be perfect. */
    failures += set_platform(&model, &inputs, &loop.platform, MOST_MOVED, length, at_rest, NULL) != DYN_STATUS_OK;
    failures += dyn_check_limits(&model, &inputs, &limits, NULL) != DYN_STATUS_OK;
    limits.minimum_condition_bound = 1;
    failures += dyn_check_limits(&model, &inputs, &limits, NULL) != DYN_STATUS_BEYOND_LIMIT;
    limits.minimum_condition_bound = 0;

    /* Without any term of the reference's own acceleration and velocity it is more. */
    astray = closed_loop(&model, &limits, &coils);
    failures += !(astray < 1e-4);
    printf("documented loop: %d failures, closed loop: %g\n", failures, (double)astray);
    return failures;
}
