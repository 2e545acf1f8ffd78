/*
 * What the library refuses, and that it then leaves everything alone: null pointers, sizes of structs, unknown models, and
 * every bad situation that inputs can make.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "dyn_capi.h"

static int failures;

#define UNTOUCHED ((dyn_real)12345)

static dyn_model model = { .struct_size = sizeof model, .kind = DYN_MODEL_KIND_BAKED };
static dyn_inputs home = {
    .struct_size = sizeof home,
    .base_rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
    .platform_position = { 0, 0, (dyn_real)0.382 },
    .platform_rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
};

static void check(int good, const char *what)
{
    if (!good) {
        fprintf(stderr, "%s\n", what);
        failures++;
    }
}

/* A call that must end with this status, and leave the output alone unless that is DYN_STATUS_OK. */
static dyn_info expect(dyn_status expected, const dyn_model *a_model, const dyn_inputs *inputs, const char *what)
{
    dyn_info info = { .struct_size = sizeof info };
    dyn_real force[6] = { UNTOUCHED, UNTOUCHED, UNTOUCHED, UNTOUCHED, UNTOUCHED, UNTOUCHED };
    dyn_status status = dyn_inverse_dynamics(a_model, inputs, &force, &info);
    int leg;

    if (status != expected) {
        fprintf(stderr, "%s: status %d, expected %d\n", what, (int)status, (int)expected);
        failures++;
    }
    for (leg = 0; leg < 6; leg++) {
        check((force[leg] == UNTOUCHED) == (expected != DYN_STATUS_OK), what);
    }
    check(dyn_inverse_dynamics(a_model, inputs, &force, NULL) == expected, "details are optional");
    return info;
}

static void pointers(void)
{
    dyn_real force[6];
    dyn_energy_result energy = { .struct_size = sizeof energy };
    dyn_real rotation[3][3];

    expect(DYN_STATUS_OK, &model, &home, "home");
    expect(DYN_STATUS_NULL_POINTER, NULL, &home, "no model");
    expect(DYN_STATUS_NULL_POINTER, &model, NULL, "no inputs");
    check(dyn_inverse_dynamics(&model, &home, NULL, NULL) == DYN_STATUS_NULL_POINTER, "no output");
    check(dyn_energy(&model, &home, NULL, NULL) == DYN_STATUS_NULL_POINTER, "no struct for the output");
    check(dyn_energy(&model, &home, &energy, NULL) == DYN_STATUS_OK, "energy");
    check(dyn_check_model(&model, NULL) == DYN_STATUS_OK, "the baked model was checked when it was made");
    check(dyn_check_model(NULL, NULL) == DYN_STATUS_NULL_POINTER, "no model to check");
    check(dyn_rotation_from_angles(NULL, &rotation, NULL) == DYN_STATUS_NULL_POINTER, "no angles");
    check(dyn_inverse_dynamics(&model, &home, (dyn_real(*)[6])((char *)&force + 1), NULL) == DYN_STATUS_NULL_POINTER,
          "an output that is not aligned");
}

static void sizes(void)
{
    dyn_model other_model = model;
    dyn_inputs other_inputs = home;
    dyn_energy_result energy = { .struct_size = sizeof energy - 1, .kinetic_energy = UNTOUCHED };
    dyn_info info = { .struct_size = 1, .leg = 77 };
    dyn_real force[6] = { UNTOUCHED };
    dyn_uhp_parameters parameters;

    other_model.struct_size = 0;
    expect(DYN_STATUS_WRONG_STRUCT_SIZE, &other_model, &home, "size of the model");
    other_inputs.struct_size += 8;
    expect(DYN_STATUS_WRONG_STRUCT_SIZE, &model, &other_inputs, "size of the inputs");
    check(dyn_energy(&model, &home, &energy, NULL) == DYN_STATUS_WRONG_STRUCT_SIZE, "size of the output");
    check(energy.kinetic_energy == UNTOUCHED, "an output of the wrong size is left alone");
    check(dyn_inverse_dynamics(&model, &home, &force, &info) == DYN_STATUS_WRONG_STRUCT_SIZE, "size of the details");
    check(info.leg == 77 && force[0] == UNTOUCHED, "details of the wrong size are left alone, and so is the output");

    other_model = model;
    other_model.kind = 99;
    expect(DYN_STATUS_UNKNOWN_MODEL, &other_model, &home, "no such model");
    other_model.kind = DYN_MODEL_KIND_UHP;
    expect(DYN_STATUS_NULL_POINTER, &other_model, &home, "no parameters");
    memset(&parameters, 0, sizeof parameters);
    other_model.uhp = &parameters;
    expect(DYN_STATUS_WRONG_STRUCT_SIZE, &other_model, &home, "size of the parameters");
    parameters.struct_size = sizeof parameters;
    check(expect(DYN_STATUS_INVALID_MODEL, &other_model, &home, "parameters left at zero").leg == 0, "the first leg");
}

static void inputs(void)
{
    dyn_inputs bad = home;
    dyn_info info;
    int i;

    bad.base_velocity[4] = (dyn_real)NAN;
    info = expect(DYN_STATUS_NON_FINITE, &model, &bad, "NaN");
    check(info.input == DYN_INPUT_BASE_VELOCITY && info.leg == -1, "the input with NaN");
    bad = home;
    bad.external_wrench[0] = (dyn_real)INFINITY;
    check(expect(DYN_STATUS_NON_FINITE, &model, &bad, "infinite").input == DYN_INPUT_EXTERNAL_WRENCH, "the infinite input");

    bad = home;
    memset(bad.platform_rotation, 0, sizeof bad.platform_rotation);
    info = expect(DYN_STATUS_NOT_A_ROTATION, &model, &bad, "a rotation forgotten");
    check(info.input == DYN_INPUT_PLATFORM_ROTATION && info.value == 1 && info.limit < info.value, "which, how far off");
    bad = home;
    bad.base_rotation[2][2] = -1;
    info = expect(DYN_STATUS_NOT_A_ROTATION, &model, &bad, "a reflection");
    check(info.input == DYN_INPUT_BASE_ROTATION && info.value <= info.limit, "a reflection is orthonormal");

    bad = home;
    bad.platform_position[0] = 10;
    check(expect(DYN_STATUS_OUT_OF_REACH, &model, &bad, "10 m aside").leg >= 0, "a leg");

    bad = home;
    for (i = 0; i < 6; i++) {
        bad.platform_acceleration[i] = sizeof(dyn_real) == 8 ? (dyn_real)1e308 : (dyn_real)1e38;
    }
    expect(DYN_STATUS_NON_FINITE_RESULT, &model, &bad, "too large to compute with");
}

/* Six uprights in a row hold no moment about that row, whatever their forces. */
static void singular(void)
{
    dyn_uhp_parameters parameters;
    dyn_model row = { .struct_size = sizeof row, .kind = DYN_MODEL_KIND_UHP };
    dyn_inputs pose = home;
    dyn_info info = { .struct_size = sizeof info };
    int leg;

    memset(&parameters, 0, sizeof parameters);
    parameters.struct_size = sizeof parameters;
    parameters.payload_mass = 1;
    for (leg = 0; leg < 6; leg++) {
        parameters.base_point[leg][0] = parameters.platform_point[leg][0] = (dyn_real)0.1 * (dyn_real)(leg + 1);
        parameters.actuator_axis[leg][2] = 1;
        parameters.rod_length[leg] = 1;
        parameters.rod_mass[leg] = parameters.mover_mass[leg] = 1;
    }
    row.uhp = &parameters;
    check(dyn_check_model(&row, &info) == DYN_STATUS_INVALID_PARAMETER, "rods without inertia");
    check(info.input == DYN_INPUT_ROD_INERTIA && info.leg == 0 && info.value == 0, "which parameter");
    parameters.actuator_axis[4][2] = 2;
    check(dyn_check_model(&row, &info) == DYN_STATUS_INVALID_PARAMETER, "an axis of length 2");
    check(info.input == DYN_INPUT_ACTUATOR_AXIS && info.leg == 4 && info.value == 2, "which leg");
    parameters.actuator_axis[4][2] = 1;
    pose.platform_position[2] = 2;
    info = expect(DYN_STATUS_SINGULAR_JACOBIAN, &row, &pose, "legs in a row");
    check(info.value < info.limit && info.limit > 0, "how singular");
    /* All but across: a rod of length 1 whose ends are 0.99999 apart sideways. */
    pose.platform_position[0] = (dyn_real)0.99999;
    info = expect(DYN_STATUS_ROD_PERPENDICULAR, &row, &pose, "rods across");
    check(info.leg == 0, "the first leg across");
}

static void conversions(void)
{
    static const dyn_real upright[3] = { 0, (dyn_real)1.5707963267948966, 0 };
    static const dyn_real spin[3] = { 1, 0, 0 };
    dyn_real quaternion[4] = { 1, 0, 0, 0 }, rotation[3][3], rates[3] = { UNTOUCHED }, angular_velocity[3];
    dyn_info info = { .struct_size = sizeof info };
    dyn_real norm = 0;
    int i;

    check(dyn_rotation_from_quaternion(quaternion, &rotation, &info) == DYN_STATUS_OK, "a unit quaternion");
    check(rotation[1][1] == 1 && rotation[0][1] == 0, "no rotation");
    /* A half turn about an axis in the plane, with the norm that single precision leaves. */
    quaternion[0] = 0;
    quaternion[1] = (dyn_real)0.6 * (1 + (dyn_real)1e-7);
    quaternion[2] = (dyn_real)0.8 * (1 + (dyn_real)1e-7);
    check(dyn_rotation_from_quaternion(quaternion, &rotation, &info) == DYN_STATUS_OK, "rounded in single precision");
    for (i = 0; i < 3; i++) {
        norm += rotation[i][0] * rotation[i][0];
    }
    check(fabs((double)norm - 1) < (sizeof(dyn_real) == 8 ? 1e-15 : 1e-6), "the norm is divided out");
    quaternion[0] = 1;
    quaternion[2] = 0;
    quaternion[1] = 1;
    check(dyn_rotation_from_quaternion(quaternion, &rotation, &info) == DYN_STATUS_NOT_A_ROTATION, "not of norm 1");
    check(info.input == DYN_INPUT_QUATERNION && info.value == 1, "how far from norm 1");
    check(dyn_angle_rates(upright, spin, &rates, &info) == DYN_STATUS_GIMBAL_LOCK, "gimbal lock");
    check(rates[0] == UNTOUCHED && info.input == DYN_INPUT_ANGLES, "rates are left alone");
    check(dyn_angular_velocity(spin, spin, &angular_velocity, &info) == DYN_STATUS_OK, "angular velocity");
    check(angular_velocity[0] == 1, "spin about x");
}

static void texts(void)
{
    int status;

    for (status = DYN_STATUS_OK; status <= DYN_STATUS_NOT_IN_MODEL; status++) {
        check(strcmp(dyn_status_text(status), dyn_status_text(-1)) != 0, "every status has a text");
    }
    check(strcmp(dyn_status_text(1000), dyn_status_text(-1)) == 0, "other numbers have one too");
    check(strcmp(dyn_input_text(DYN_INPUT_BASE_VELOCITY), "base_velocity") == 0, "name of an input");
    check(strcmp(dyn_input_text(1000), dyn_input_text(-2)) == 0, "no name of an input");
}

int main(void)
{
    pointers();
    sizes();
    inputs();
    singular();
    conversions();
    texts();
    printf("%d failures\n", failures);
    return failures != 0;
}
