/*
 * A stub of Simulink's simstruc.h: as much as dyn_platform.c uses, with the documented signatures, over a plain struct.
 * It is no Simulink; it serves to compile the S-function and to call it once.
 */
#ifndef SIMSTRUC_H
#define SIMSTRUC_H

typedef double real_T;
typedef int int_T;
typedef unsigned int uint_T;

typedef struct mxArray {
    double scalar;
} mxArray;

#define STUB_PORTS 8
#define STUB_WIDTH 32

typedef struct SimStruct {
    mxArray parameter;
    int_T parameter_count;
    const char *error;
    int_T input_ports, output_ports, real_work;
    int_T input_widths[STUB_PORTS], output_widths[STUB_PORTS];
    int_T contiguous[STUB_PORTS], feedthrough[STUB_PORTS];
    real_T inputs[STUB_PORTS][STUB_WIDTH], outputs[STUB_PORTS][STUB_WIDTH], work[STUB_WIDTH];
    real_T sample_time, offset;
    uint_T options;
} SimStruct;

#define INHERITED_SAMPLE_TIME (-1.0)
#define SS_OPTION_EXCEPTION_FREE_CODE 0x00000001

#define mxGetScalar(array) ((array)->scalar)
#define ssGetSFcnParam(S, index) ((void)(index), &(S)->parameter)
#define ssSetNumSFcnParams(S, count) ((S)->parameter_count = (count))
#define ssGetNumSFcnParams(S) ((S)->parameter_count)
#define ssGetSFcnParamsCount(S) ((void)(S), 1)
#define ssSetSFcnParamTunable(S, index, tunable) ((void)(S), (void)(index), (void)(tunable))
#define ssSetErrorStatus(S, text) ((S)->error = (text))
#define ssSetNumContStates(S, count) ((void)(S), (void)(count))
#define ssSetNumDiscStates(S, count) ((void)(S), (void)(count))
#define ssSetNumInputPorts(S, count) ((S)->input_ports = (count), (count) <= STUB_PORTS)
#define ssSetNumOutputPorts(S, count) ((S)->output_ports = (count), (count) <= STUB_PORTS)
#define ssSetInputPortWidth(S, port, width) ((S)->input_widths[port] = (width))
#define ssSetOutputPortWidth(S, port, width) ((S)->output_widths[port] = (width))
#define ssSetInputPortRequiredContiguous(S, port, flag) ((S)->contiguous[port] = (flag))
#define ssSetInputPortDirectFeedThrough(S, port, flag) ((S)->feedthrough[port] = (flag))
#define ssGetInputPortRealSignal(S, port) ((const real_T *)(S)->inputs[port])
#define ssGetOutputPortRealSignal(S, port) ((real_T *)(S)->outputs[port])
#define ssSetNumSampleTimes(S, count) ((void)(S), (void)(count))
#define ssSetNumRWork(S, count) ((S)->real_work = (count))
#define ssGetRWork(S) ((real_T *)(S)->work)
#define ssSetSampleTime(S, index, time) ((void)(index), (S)->sample_time = (time))
#define ssSetOffsetTime(S, index, time) ((void)(index), (S)->offset = (time))
#define ssSetOptions(S, flags) ((S)->options = (flags))

#endif
