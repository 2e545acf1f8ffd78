/*
 * What Simulink does with an S-function, once: initialise, give it inputs, ask for outputs. Stands where Simulink has the
 * file that connects a block to generated code.
 */
#include <math.h>
#include <stdio.h>

static SimStruct block;
static int failures;

static void check(int good, const char *what)
{
    if (!good) {
        fprintf(stderr, "%s\n", what);
        failures++;
    }
}

/* A body at rest: position, then the columns of R = Rz(0.1). */
static void set_pose(real_T *port, double x, double z)
{
    static const double rotation[9] = { 0.99500416527802582, 0.099833416646828155, 0, -0.099833416646828155,
                                        0.99500416527802582, 0, 0, 0, 1 };
    int i;

    port[0] = x;
    port[1] = 0;
    port[2] = z;
    for (i = 0; i < 9; i++) {
        port[3 + i] = rotation[i];
    }
}

static void run(int kind, const real_T demand[6])
{
    int i;

    block.parameter.scalar = kind;
    block.error = 0;
    mdlInitializeSizes(&block);
    mdlInitializeSampleTimes(&block);
    mdlStart(&block);
    set_pose(block.inputs[BASE], 0, 0);
    set_pose(block.inputs[PLATFORM], 0, 0.382);
    for (i = 0; i < 6; i++) {
        block.inputs[DEMAND][i] = demand[i];
    }
    mdlOutputs(&block, 0);
}

int main(void)
{
    static const real_T wanted[6] = { 0.1, 0.2, 0.3, 0.4, 0.5, 0.6 };
    real_T force[6], acceleration[6];
    int i;

    run(INVERSE, wanted);
    check(block.error == 0 && block.outputs[STATUS][0] == 0 && block.outputs[LEG][0] == 0, "inverse dynamics");
    check(block.input_ports == 4 && block.input_widths[BASE] == 24 && block.input_widths[PLATFORM] == 18, "ports");
    for (i = 0; i < 6; i++) {
        force[i] = block.outputs[RESULT][i];
    }
    run(FORWARD, force);
    for (i = 0; i < 6; i++) {
        acceleration[i] = block.outputs[RESULT][i];
        check(fabs(acceleration[i] - wanted[i]) < (sizeof(dyn_real) == 8 ? 1e-10 : 1e-2), "the forces give the acceleration that they were asked for");
    }
    /* Out of reach: the last good result, and which leg. */
    set_pose(block.inputs[PLATFORM], 0.5, 0.382);
    mdlOutputs(&block, 0);
    check(block.outputs[STATUS][0] == DYN_STATUS_OUT_OF_REACH && block.outputs[LEG][0] >= 1, "status and leg");
    check(block.outputs[RESULT][0] == acceleration[0], "the last good result stays");

    block.parameter.scalar = 3;
    mdlInitializeSizes(&block);
    check(block.error != 0, "a parameter that is neither 1 nor 2");
    mdlTerminate(&block);
    printf("S-function: %d failures\n", failures);
    return failures != 0;
}
