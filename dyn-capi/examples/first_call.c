/*
 * Forces that hold the platform still while its base shakes: the first call of the library.
 *
 *     cargo build --release -p dyn-capi
 *     cc -std=c99 -I dyn-capi/include dyn-capi/examples/first_call.c target/release/libdyn_capi.a -lm -lpthread -ldl
 */
#include <stdio.h>

#include "dyn_capi.h"

int main(void)
{
    /* Everything that is not named is zero. */
    const dyn_model model = { .struct_size = sizeof model, .kind = DYN_MODEL_KIND_BAKED };
    dyn_info info = { .struct_size = sizeof info };
    dyn_inputs inputs = {
        .struct_size = sizeof inputs,
        .base_rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
        .base_acceleration = { 0.981, 0, 0, 0, 0, 0 }, /* 0.1 g along x */
        .platform_position = { 0, 0, 0.382 },          /* home */
        .platform_rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
    };
    dyn_real force[6];
    dyn_status status;
    int leg;

    status = dyn_inverse_dynamics(&model, &inputs, &force, &info);
    if (status != DYN_STATUS_OK) {
        /* Legs are 0 to 5 in the interface, 1 to 6 for people; 0 here is none. */
        fprintf(stderr, "%s (input %s, leg %d)\n", dyn_status_text(status), dyn_input_text(info.input), (int)info.leg + 1);
        return 1;
    }
    printf("platform %s\n", dyn_baked_platform_name());
    for (leg = 0; leg < 6; leg++) {
        printf("force of actuator %d: %9.4f N\n", leg + 1, (double)force[leg]);
    }

    /* Every bad situation has a status, and leaves the forces as they were. */
    inputs.platform_position[0] = 0.5;
    status = dyn_inverse_dynamics(&model, &inputs, &force, &info);
    printf("0.5 m aside: status %d, leg %d: %s\n", (int)status, (int)info.leg + 1, dyn_status_text(status));
    return status == DYN_STATUS_OUT_OF_REACH ? 0 : 1;
}
