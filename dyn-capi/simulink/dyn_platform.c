/*
 * Level-2 C S-function: the dynamics of a hexapod on a moving base, of the platform baked into the library.
 *
 * NOT RUN IN SIMULINK: this source compiles and runs against a stub of simstruc.h (dyn-capi/tests/simulink), which has the
 * functions and macros used here with their documented signatures. Nobody has loaded it into Simulink yet.
 *
 *     mex -Idyn-capi/include dyn-capi/simulink/dyn_platform.c target/release/libdyn_capi.a
 *
 * Block parameter: what the block computes, 1 = inverse dynamics (forces), 2 = forward dynamics (acceleration).
 *
 * Inputs, SI units, axes of the inertial frame O:
 *     1  base:     [position 3; rotation 9; velocity 6; acceleration 6]
 *     2  platform: [position 3; rotation 9; velocity 6], and as
 *     3  demand:   [r_p''; w_p'] wanted for inverse dynamics, six actuator forces for forward dynamics
 *     4  external wrench: [F_D; M_D] at the payload's centre of mass
 * Rotations are the nine numbers of R as MATLAB stores it, R(:), column by column; R turns body into O coordinates.
 *
 * Outputs:
 *     1  six forces (N), or the platform's acceleration [r_p''; w_p']; while status is not 0, the last good ones
 *     2  status, 0 for good; see dyn_capi.h and docs/control-loop.md
 *     3  the leg to blame, 1 to 6, or 0
 */
#define S_FUNCTION_NAME dyn_platform
#define S_FUNCTION_LEVEL 2

#include "simstruc.h"

#include "dyn_capi.h"

enum { BASE, PLATFORM, DEMAND, WRENCH, INPUT_PORTS };
enum { RESULT, STATUS, LEG, OUTPUT_PORTS };
enum { INVERSE = 1, FORWARD = 2 };

static const int input_widths[INPUT_PORTS] = { 24, 18, 6, 6 };
static const int output_widths[OUTPUT_PORTS] = { 6, 1, 1 };

/* What the block computes, or 0 if the parameter is neither. */
static int what(SimStruct *S)
{
    const double parameter = mxGetScalar(ssGetSFcnParam(S, 0));
    return parameter == INVERSE ? INVERSE : parameter == FORWARD ? FORWARD : 0;
}

static void mdlInitializeSizes(SimStruct *S)
{
    int port;

    ssSetNumSFcnParams(S, 1);
    if (ssGetNumSFcnParams(S) != ssGetSFcnParamsCount(S)) {
        return; /* Simulink says so itself. */
    }
    if (what(S) == 0) {
        ssSetErrorStatus(S, "dyn_platform: the parameter is 1 (inverse dynamics) or 2 (forward dynamics)");
        return;
    }
    ssSetSFcnParamTunable(S, 0, 0);
    ssSetNumContStates(S, 0);
    ssSetNumDiscStates(S, 0);
    if (!ssSetNumInputPorts(S, INPUT_PORTS) || !ssSetNumOutputPorts(S, OUTPUT_PORTS)) {
        return;
    }
    for (port = 0; port < INPUT_PORTS; port++) {
        ssSetInputPortWidth(S, port, input_widths[port]);
        ssSetInputPortRequiredContiguous(S, port, 1);
        ssSetInputPortDirectFeedThrough(S, port, 1);
    }
    for (port = 0; port < OUTPUT_PORTS; port++) {
        ssSetOutputPortWidth(S, port, output_widths[port]);
    }
    ssSetNumSampleTimes(S, 1);
    ssSetNumRWork(S, 6); /* the last good result */
    ssSetOptions(S, SS_OPTION_EXCEPTION_FREE_CODE);
}

static void mdlInitializeSampleTimes(SimStruct *S)
{
    ssSetSampleTime(S, 0, INHERITED_SAMPLE_TIME);
    ssSetOffsetTime(S, 0, 0.0);
}

#define MDL_START
static void mdlStart(SimStruct *S)
{
    int i;

    for (i = 0; i < 6; i++) {
        ssGetRWork(S)[i] = 0;
    }
}

static const real_T *copy(dyn_real *to, const real_T *from, int count)
{
    int i;

    for (i = 0; i < count; i++) {
        to[i] = (dyn_real)from[i];
    }
    return from + count;
}

/* MATLAB stores columns, the library takes rows. */
static const real_T *copy_rotation(dyn_real to[3][3], const real_T *from)
{
    int row, column;

    for (row = 0; row < 3; row++) {
        for (column = 0; column < 3; column++) {
            to[row][column] = (dyn_real)from[3 * column + row];
        }
    }
    return from + 9;
}

static void mdlOutputs(SimStruct *S, int_T tid)
{
    static const dyn_model model = { .struct_size = sizeof(dyn_model), .kind = DYN_MODEL_KIND_BAKED };
    const real_T *base = ssGetInputPortRealSignal(S, BASE);
    const real_T *platform = ssGetInputPortRealSignal(S, PLATFORM);
    const real_T *demand = ssGetInputPortRealSignal(S, DEMAND);
    real_T *last = ssGetRWork(S);
    dyn_inputs inputs = { .struct_size = sizeof inputs };
    dyn_info info = { .struct_size = sizeof info };
    dyn_real result[6];
    dyn_status status;
    int i;

    (void)tid;
    base = copy(inputs.base_position, base, 3);
    base = copy_rotation(inputs.base_rotation, base);
    base = copy(inputs.base_velocity, base, 6);
    copy(inputs.base_acceleration, base, 6);
    platform = copy(inputs.platform_position, platform, 3);
    platform = copy_rotation(inputs.platform_rotation, platform);
    copy(inputs.platform_velocity, platform, 6);
    copy(inputs.external_wrench, ssGetInputPortRealSignal(S, WRENCH), 6);
    if (what(S) == INVERSE) {
        copy(inputs.platform_acceleration, demand, 6);
        status = dyn_inverse_dynamics(&model, &inputs, &result, &info);
    } else {
        copy(inputs.actuator_force, demand, 6);
        status = dyn_forward_dynamics(&model, &inputs, &result, &info);
    }
    for (i = 0; i < 6; i++) {
        if (status == DYN_STATUS_OK) {
            last[i] = (real_T)result[i];
        }
        ssGetOutputPortRealSignal(S, RESULT)[i] = last[i];
    }
    ssGetOutputPortRealSignal(S, STATUS)[0] = (real_T)status;
    ssGetOutputPortRealSignal(S, LEG)[0] = (real_T)(info.leg + 1);
}

static void mdlTerminate(SimStruct *S)
{
    (void)S;
}

#ifdef MATLAB_MEX_FILE
#include "simulink.c"
#else
#include "cg_sfun.h"
#endif
