/*
 * Every call about a model against test vectors: reads records from a file, compares what the library computes.
 *
 *     vectors FILE
 *
 * A record is a line: what it is, a name, a count, as many numbers (row-major), separated by blanks.
 *
 *     platform  NAME 0          a platform begins; its name tells whether it is the baked one
 *     leg_type  NAME 0          uhp or ups
 *     parameter NAME COUNT ...  one of its parameters
 *     input     NAME COUNT ...  a member of dyn_inputs
 *     case      -    0          all inputs are read: call everything
 *     output    NAME COUNT ...  expected, relative to its largest element or to the first number, a scale
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "dyn_capi.h"

#define TOLERANCE (sizeof(dyn_real) == 8 ? 1e-11 : 1e-3)
#define MAX_NUMBERS 64

/* A name and the numbers that go with it. */
typedef struct slot {
    const char *name;
    dyn_real *numbers;
    int count;
} slot;

#define SLOT(place, member) { #member, (dyn_real *)&(place).member, (int)(sizeof(place).member / sizeof(dyn_real)) }

static dyn_uhp_parameters parameters = { .struct_size = sizeof parameters };
static dyn_ups_parameters ups_parameters = { .struct_size = sizeof ups_parameters };
static dyn_inputs inputs = { .struct_size = sizeof inputs };
static dyn_model at_run_time = { .struct_size = sizeof at_run_time, .uhp = &parameters, .ups = &ups_parameters };
static dyn_model baked = { .struct_size = sizeof baked, .kind = DYN_MODEL_KIND_BAKED };
static dyn_info info = { .struct_size = sizeof info };

static const slot parameter_slots[] = {
    SLOT(parameters, base_point), SLOT(parameters, actuator_axis), SLOT(parameters, platform_point),
    SLOT(parameters, rod_length), SLOT(parameters, rod_mass), SLOT(parameters, rod_inertia),
    SLOT(parameters, rod_com_fraction), SLOT(parameters, mover_mass), SLOT(parameters, mover_offset),
    SLOT(parameters, rest_length), SLOT(parameters, axial_stiffness), SLOT(parameters, axial_damping),
    SLOT(parameters, payload_mass), SLOT(parameters, payload_com), SLOT(parameters, payload_inertia),
    SLOT(parameters, gravity), SLOT(ups_parameters, base_point), SLOT(ups_parameters, platform_point),
    SLOT(ups_parameters, lower_mass), SLOT(ups_parameters, lower_com_distance),
    SLOT(ups_parameters, lower_inertia), SLOT(ups_parameters, upper_mass),
    SLOT(ups_parameters, upper_com_distance), SLOT(ups_parameters, upper_inertia),
    SLOT(ups_parameters, rest_length), SLOT(ups_parameters, axial_stiffness),
    SLOT(ups_parameters, axial_damping), SLOT(ups_parameters, payload_mass),
    SLOT(ups_parameters, payload_com), SLOT(ups_parameters, payload_inertia),
    SLOT(ups_parameters, gravity), { 0, 0, 0 }
};

static const slot input_slots[] = {
    SLOT(inputs, base_position), SLOT(inputs, base_rotation), SLOT(inputs, base_velocity),
    SLOT(inputs, base_acceleration), SLOT(inputs, platform_position), SLOT(inputs, platform_rotation),
    SLOT(inputs, platform_velocity), SLOT(inputs, platform_acceleration), SLOT(inputs, actuator_force),
    SLOT(inputs, external_wrench), { "platform_velocity", inputs.reference_velocity, 6 }, { 0, 0, 0 }
};

/* Outputs: of functions with one array, then of those with a struct. */
static struct {
    dyn_real rod_alignment[6], jacobian_dp[6][6], jacobian_db[6][6], mass_matrix_p[6][6], mass_matrix_b[6][6], bias[6],
        inverse_dynamics[6], forward_dynamics[6], passive_inverse_dynamics[6], base_wrench[6];
} out;
static dyn_leg_kinematics_result legs = { .struct_size = sizeof legs };
static dyn_stiffness_matrices_result stiffness = { .struct_size = sizeof stiffness };
static dyn_passive_forces_result passive = { .struct_size = sizeof passive };
static dyn_coriolis_matrices_result coriolis = { .struct_size = sizeof coriolis };
static dyn_matrices_result matrices = { .struct_size = sizeof matrices };
static dyn_equation_of_motion_result equation = { .struct_size = sizeof equation };
static dyn_control_result control = { .struct_size = sizeof control };
static dyn_energy_result energy = { .struct_size = sizeof energy };

/* An output that several functions give appears once for each. */
static const slot output_slots[] = {
    SLOT(out, rod_alignment), SLOT(out, jacobian_dp), SLOT(out, jacobian_db), SLOT(out, mass_matrix_p),
    SLOT(out, mass_matrix_b), SLOT(out, bias), SLOT(out, inverse_dynamics), SLOT(out, forward_dynamics),
    SLOT(legs, actuator_length), SLOT(legs, actuator_velocity), SLOT(legs, actuator_acceleration),
    SLOT(legs, rod_direction), SLOT(legs, hooke_joint_position), SLOT(legs, platform_joint_position),
    SLOT(legs, platform_joint_rate), SLOT(stiffness, stiffness_matrix_p), SLOT(stiffness, stiffness_matrix_b),
    SLOT(passive, gravity_force), SLOT(passive, spring_force), SLOT(passive, damping_force),
    SLOT(coriolis, coriolis_matrix_p), SLOT(coriolis, coriolis_matrix_b), SLOT(matrices, mass_matrix_p),
    SLOT(matrices, coriolis_matrix_p), SLOT(matrices, jacobian_dp), SLOT(matrices, mass_matrix_b),
    SLOT(matrices, coriolis_matrix_b), SLOT(matrices, jacobian_db), SLOT(equation, mass_matrix_p),
    SLOT(equation, coriolis_matrix_p), SLOT(equation, stiffness_matrix_p), SLOT(equation, jacobian_dp),
    SLOT(equation, mass_matrix_b), SLOT(equation, coriolis_matrix_b), SLOT(equation, stiffness_matrix_b),
    SLOT(equation, jacobian_db), SLOT(equation, gravity_force), SLOT(equation, spring_force),
    SLOT(equation, damping_force), SLOT(equation, bias), SLOT(energy, kinetic_energy),
    SLOT(energy, potential_energy), SLOT(out, base_wrench), SLOT(control, actuator_length),
    SLOT(control, actuator_velocity), SLOT(control, jacobian_dp), SLOT(control, mass_matrix_p),
    { "inverse_dynamics", control.actuator_force, 6 },
    /* At the actual velocity forces for passivity-based control are those of inverse dynamics. */
    { "inverse_dynamics", out.passive_inverse_dynamics, 6 }, { 0, 0, 0 }
};

static long failures, compared;
static double worst;

static void fail(const char *what, const char *name)
{
    failures++;
    if (failures <= 20) {
        fprintf(stderr, "%s: %s\n", what, name);
    }
}

/* Puts numbers into every slot of that name. */
static void fill(const slot *slots, const char *name, const double *numbers, int count)
{
    int i, found = 0;
    for (; slots->name; slots++) {
        if (strcmp(slots->name, name) == 0 && slots->count == count) {
            for (i = 0; i < count; i++) {
                slots->numbers[i] = (dyn_real)numbers[i];
            }
            found = 1;
        }
    }
    if (!found) {
        fail("no place for", name);
    }
}

static void call_everything(const dyn_model *model)
{
#define CALL(function, output)                                                      \
    do {                                                                            \
        dyn_status status = dyn_##function(model, &inputs, &(output), &info);       \
        if (status != DYN_STATUS_OK) {                                              \
            fail(#function, dyn_status_text(status));                               \
        }                                                                           \
    } while (0)

    CALL(rod_alignment, out.rod_alignment);
    CALL(jacobian_dp, out.jacobian_dp);
    CALL(jacobian_db, out.jacobian_db);
    CALL(mass_matrix_p, out.mass_matrix_p);
    CALL(mass_matrix_b, out.mass_matrix_b);
    CALL(bias, out.bias);
    CALL(inverse_dynamics, out.inverse_dynamics);
    CALL(forward_dynamics, out.forward_dynamics);
    CALL(leg_kinematics, legs);
    CALL(stiffness_matrices, stiffness);
    CALL(passive_forces, passive);
    CALL(coriolis_matrices, coriolis);
    CALL(matrices, matrices);
    CALL(equation_of_motion, equation);
    CALL(energy, energy);
    CALL(control, control);
    CALL(passive_inverse_dynamics, out.passive_inverse_dynamics);
    CALL(base_reaction, out.base_wrench);
}

/* Compares every output of that name; one that no call here gives is left out. */
static void compare(const char *name, const double *expected, int count)
{
    const slot *found;
    int i;
    double scale = expected[0];

    expected++;
    count--;
    for (i = 0; i < count; i++) {
        scale = fmax(scale, fabs(expected[i]));
    }
    for (found = output_slots; found->name; found++) {
        double deviation = 0;
        if (strcmp(found->name, name) != 0) {
            continue;
        }
        if (found->count != count) {
            fail("number of elements", name);
            continue;
        }
        for (i = 0; i < count; i++) {
            double difference = fabs((double)found->numbers[i] - expected[i]);
            /* Written so that NaN counts as the worst. */
            deviation = difference <= deviation ? deviation : difference;
        }
        compared++;
        if (deviation > 0 || deviation != deviation) {
            deviation /= scale;
        }
        worst = deviation <= worst ? worst : deviation;
        if (!(deviation <= TOLERANCE)) {
            fail("deviates", name);
        }
    }
}

/* All records for one kind of model; those of other platforms are passed over by the baked one. */
static int run(const char *path, const dyn_model *model)
{
    char kind[32], name[64];
    double numbers[MAX_NUMBERS];
    int count, i, ours = 1;
    FILE *file = fopen(path, "r");

    if (!file) {
        fprintf(stderr, "%s cannot be read\n", path);
        return 0;
    }
    while (fscanf(file, "%31s %63s %d", kind, name, &count) == 3) {
        if (count < 0 || count > MAX_NUMBERS) {
            fail("too many numbers", name);
            break;
        }
        for (i = 0; i < count; i++) {
            if (fscanf(file, "%lf", &numbers[i]) != 1) {
                fail("not a number", name);
            }
        }
        if (strcmp(kind, "platform") == 0) {
            ours = model != &baked || strcmp(name, dyn_baked_platform_name()) == 0;
        } else if (!ours) {
            continue;
        } else if (strcmp(kind, "leg_type") == 0) {
            at_run_time.kind = strcmp(name, "ups") == 0 ? DYN_MODEL_KIND_UPS : DYN_MODEL_KIND_UHP;
        } else if (strcmp(kind, "parameter") == 0) {
            fill(parameter_slots, name, numbers, count);
        } else if (strcmp(kind, "input") == 0) {
            fill(input_slots, name, numbers, count);
        } else if (strcmp(kind, "case") == 0) {
            if (dyn_check_model(model, &info) != DYN_STATUS_OK) {
                fail("parameter", dyn_input_text(info.input));
            }
            call_everything(model);
        } else if (strcmp(kind, "output") == 0 && count > 1) {
            compare(name, numbers, count);
        } else {
            fail("no such record", kind);
        }
    }
    fclose(file);
    return 1;
}

int main(int argc, char **argv)
{
    if (argc != 2 || !run(argv[1], &at_run_time) || !run(argv[1], &baked)) {
        fprintf(stderr, "usage: vectors FILE\n");
        return 2;
    }
    printf("%ld arrays compared, largest deviation %.1e (tolerance %.0e), %ld failures\n", compared, worst, TOLERANCE,
           failures);
    return failures == 0 && compared > 0 ? 0 : 1;
}
