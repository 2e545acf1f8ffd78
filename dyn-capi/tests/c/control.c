/*
 * The calls that a control loop is made of: there and back again, and what they refuse.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "dyn_capi.h"

#define EXACT (sizeof(dyn_real) == 8 ? 1e-11 : 1e-5)

static int failures;

static const dyn_model model = { .struct_size = sizeof model, .kind = DYN_MODEL_KIND_BAKED };

static void check(int good, const char *what)
{
    if (!good) {
        fprintf(stderr, "%s\n", what);
        failures++;
    }
}

static dyn_inputs at(dyn_real x, dyn_real z)
{
    dyn_inputs inputs = {
        .struct_size = sizeof inputs,
        .base_rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
        .platform_position = { x, 0, z },
        .platform_rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
    };
    return inputs;
}

static int near(const dyn_real *found, const dyn_real *expected, int count)
{
    int i, good = 1;

    for (i = 0; i < count; i++) {
        good = good && fabs((double)(found[i] - expected[i])) < EXACT;
    }
    return good;
}

/* How many of some random lengths are refused because the steps lead nowhere, rather than out of reach. */
static int leads_nowhere(const dyn_real length[6], const dyn_inputs *start)
{
    dyn_forward_kinematics_result found = { .struct_size = sizeof found };
    dyn_info info = { .struct_size = sizeof info };
    dyn_real apart[6];
    unsigned long random = 1;
    int leg, attempt, count = 0;

    for (attempt = 0; attempt < 2000; attempt++) {
        for (leg = 0; leg < 6; leg++) {
            random = (random * 1103515245UL + 12345UL) & 0x7fffffffUL;
            apart[leg] = length[leg] + (dyn_real)(0.6 * ((double)random / 0x7fffffff - 0.5));
        }
        if (dyn_forward_kinematics(&model, start, apart, &found, &info) == DYN_STATUS_NO_CONVERGENCE) {
            check(info.value > 0, "how far off");
            count++;
        }
    }
    return count;
}

/* Lengths and rates of a moving platform lead back to its pose and velocity. */
static void forward_kinematics(void)
{
    dyn_inputs there = at((dyn_real)0.003, (dyn_real)0.384);
    dyn_inputs start = at(0, (dyn_real)0.382);
    const dyn_real velocity[6] = { (dyn_real)0.01, (dyn_real)-0.02, (dyn_real)0.03, (dyn_real)0.1, 0, (dyn_real)0.2 };
    dyn_leg_kinematics_result legs = { .struct_size = sizeof legs };
    dyn_forward_kinematics_result found = { .struct_size = sizeof found };
    dyn_info info = { .struct_size = sizeof info };
    dyn_real back[6] = { 0 };
    int i;

    for (i = 0; i < 6; i++) {
        there.platform_velocity[i] = velocity[i];
    }
    check(dyn_leg_kinematics(&model, &there, &legs, &info) == DYN_STATUS_OK, "lengths and rates");
    check(dyn_forward_kinematics(&model, &start, legs.actuator_length, &found, &info) == DYN_STATUS_OK, "a pose");
    check(near(found.platform_position, there.platform_position, 3), "its position");
    check(near(&found.platform_rotation[0][0], &there.platform_rotation[0][0], 9), "its rotation");
    check(found.iterations >= 1 && found.iterations <= 5 && fabs((double)found.residual) < EXACT, "its quality");
    check(dyn_platform_velocity(&model, &there, legs.actuator_velocity, &back, &info) == DYN_STATUS_OK, "a velocity");
    check(near(back, velocity, 6), "which one");

    check(leads_nowhere(legs.actuator_length, &start) > 0, "steps that lead nowhere");
    legs.actuator_length[0] += 1;
    found.iterations = 77;
    check(dyn_forward_kinematics(&model, &start, legs.actuator_length, &found, &info) == DYN_STATUS_NO_CONVERGENCE, "one leg is a metre long");
    check(found.iterations == 77, "no pose, no output");
    legs.actuator_length[0] = (dyn_real)NAN;
    check(dyn_forward_kinematics(&model, &start, legs.actuator_length, &found, &info) == DYN_STATUS_NON_FINITE, "NaN");
    check(info.input == DYN_INPUT_ACTUATOR_LENGTH && info.element == 0 && info.leg == 0, "which input");
    check(dyn_forward_kinematics(&model, &start, NULL, &found, &info) == DYN_STATUS_NULL_POINTER, "no lengths");
    found.struct_size = 0;
    check(dyn_forward_kinematics(&model, &start, velocity, &found, &info) == DYN_STATUS_WRONG_STRUCT_SIZE, "size");
}

static void limits(void)
{
    dyn_inputs low = at(0, (dyn_real)0.377);
    dyn_limits all = { .struct_size = sizeof all };
    dyn_monitor_result margins = { .struct_size = sizeof margins };
    dyn_info info = { .struct_size = sizeof info };
    int leg;

    for (leg = 0; leg < 6; leg++) {
        all.minimum_length[leg] = (dyn_real)0.195;
        all.maximum_length[leg] = all.maximum_velocity[leg] = (dyn_real)INFINITY;
        all.maximum_hooke_joint_angle[leg] = all.maximum_platform_joint_angle[leg] = (dyn_real)INFINITY;
        all.maximum_force[leg] = 50;
        low.actuator_force[leg] = 30;
    }
    check(dyn_monitor(&model, &low, &all, &margins, &info) == DYN_STATUS_OK, "margins");
    check(margins.margin[DYN_QUANTITY_ACTUATOR_FORCE] == 20 && margins.leg[DYN_QUANTITY_ACTUATOR_FORCE] >= 0, "of forces");
    check(margins.margin[DYN_QUANTITY_ACTUATOR_LENGTH] < 0, "too short");
    check(margins.margin[DYN_QUANTITY_CONDITIONING] > 0 && margins.leg[DYN_QUANTITY_CONDITIONING] == -1, "of all legs");
    check(dyn_check_limits(&model, &low, &all, &info) == DYN_STATUS_BEYOND_LIMIT, "beyond a limit");
    check(info.quantity == DYN_QUANTITY_ACTUATOR_LENGTH && info.leg >= 0 && info.value < 0, "which");
    low.platform_position[2] = (dyn_real)0.382;
    check(dyn_check_limits(&model, &low, &all, &info) == DYN_STATUS_OK && info.quantity == -1, "within limits");
    check(dyn_check_limits(&model, &low, NULL, &info) == DYN_STATUS_NULL_POINTER, "no limits");
    all.maximum_length[4] = (dyn_real)NAN;
    check(dyn_check_limits(&model, &low, &all, &info) == DYN_STATUS_INVALID_LIMIT, "a limit that is NaN");
    check(info.quantity == DYN_QUANTITY_ACTUATOR_LENGTH && info.leg == 4, "whose");
    all.maximum_length[4] = (dyn_real)INFINITY;
    all.maximum_hooke_joint_angle[1] = (dyn_real)0.1;
    check(dyn_check_limits(&model, &low, &all, &info) == DYN_STATUS_INVALID_LIMIT, "an angle from no direction");
    check(info.quantity == DYN_QUANTITY_HOOKE_JOINT_ANGLE && info.leg == 1, "of which joint");
    check(strcmp(dyn_quantity_text(info.quantity), "hooke_joint_angle") == 0, "in words");
    check(strncmp(dyn_quantity_text(-1), "not a quantity", 14) == 0, "no quantity");
}

static void currents(void)
{
    dyn_voice_coils coils = { .struct_size = sizeof coils };
    dyn_currents_result result = { .struct_size = sizeof result };
    dyn_info info = { .struct_size = sizeof info };
    const dyn_real force[6] = { 80, -20, 10, 0, 0, 40 };
    int leg;

    for (leg = 0; leg < 6; leg++) {
        coils.force_constant[leg] = 20;
        coils.maximum_current[leg] = 2;
    }
    check(dyn_currents(&coils, force, &result, &info) == DYN_STATUS_OK, "currents");
    check(result.saturated_leg == 0 && result.factor == (dyn_real)0.5, "saturation");
    check(result.current[0] == 2 && result.actuator_force[1] == -10, "all forces scaled alike");
    coils.force_constant[3] = 0;
    result.factor = 77;
    check(dyn_currents(&coils, force, &result, &info) == DYN_STATUS_INVALID_COIL && info.leg == 3, "a coil without force");
    check(result.factor == 77, "no currents, no output");
}

/* Limits of the baked model are those of its platform file, which limits nothing and names no coils; others have no file. */
static void of_the_model(void)
{
    dyn_inputs home = at(0, (dyn_real)0.382);
    dyn_leg_kinematics_result legs = { .struct_size = sizeof legs };
    dyn_model at_run_time = { .struct_size = sizeof at_run_time, .kind = DYN_MODEL_KIND_UHP };
    dyn_uhp_parameters parameters = { .struct_size = sizeof parameters };
    dyn_limits limits = { .struct_size = sizeof limits };
    dyn_voice_coils coils = { .struct_size = sizeof coils, .force_constant = { 77 } };
    dyn_info info = { .struct_size = sizeof info };

    at_run_time.uhp = &parameters;
    limits.maximum_force[0] = 77;
    check(dyn_model_limits(&at_run_time, &limits, &info) == DYN_STATUS_NOT_IN_MODEL, "limits without a platform file");
    check(limits.maximum_force[0] == 77, "no limits, no output");
    check(dyn_model_limits(&model, NULL, &info) == DYN_STATUS_NULL_POINTER, "no place for limits");
    check(dyn_model_limits(&model, &limits, &info) == DYN_STATUS_OK, "limits of the platform file");
    check(limits.struct_size == sizeof limits, "the struct's size stays");
    check(isinf((double)limits.maximum_force[0]) && limits.minimum_length[5] < -1, "nothing is limited");
    check(dyn_leg_kinematics(&model, &home, &legs, &info) == DYN_STATUS_OK, "rods at home");
    check(near(&limits.home_direction_in_base[0][0], &legs.rod_direction[0][0], 18), "their directions in the base");
    check(near(&limits.home_direction_in_platform[0][0], &legs.rod_direction[0][0], 18), "and in the platform");
    check(dyn_check_limits(&model, &home, &limits, &info) == DYN_STATUS_OK, "they are taken as they are");
    limits.maximum_length[2] = (dyn_real)0.198;
    check(dyn_check_limits(&model, &home, &limits, &info) == DYN_STATUS_BEYOND_LIMIT && info.leg == 2, "and can be added to");

    check(dyn_model_voice_coils(&model, &coils, &info) == DYN_STATUS_NOT_IN_MODEL, "no coils in the platform file");
    check(dyn_model_voice_coils(&at_run_time, &coils, &info) == DYN_STATUS_NOT_IN_MODEL, "coils without a platform file");
    check(coils.force_constant[0] == 77, "no coils, no output");
    coils.struct_size = 0;
    check(dyn_model_voice_coils(&model, &coils, &info) == DYN_STATUS_WRONG_STRUCT_SIZE, "size of the coils");
}

/* At rest the base carries the weight; a reference velocity that is NaN is refused. */
static void reaction(void)
{
    dyn_inputs home = at(0, (dyn_real)0.382);
    dyn_info info = { .struct_size = sizeof info };
    dyn_real wrench[6], force[6];

    check(dyn_base_reaction(&model, &home, &wrench, &info) == DYN_STATUS_OK, "reaction");
    check(fabs((double)wrench[2] - 15.902 * 9.81) < 1e-4, "weight");
    home.reference_velocity[2] = (dyn_real)NAN;
    check(dyn_passive_inverse_dynamics(&model, &home, &force, &info) == DYN_STATUS_NON_FINITE, "reference velocity");
    check(info.input == DYN_INPUT_REFERENCE_VELOCITY, "which input");
}

int main(void)
{
    forward_kinematics();
    limits();
    currents();
    of_the_model();
    reaction();
    printf("%d failures\n", failures);
    return failures != 0;
}
