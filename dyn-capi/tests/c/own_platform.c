/*
 * The platform that was baked in: its name, and of leg 1 the largest force, force constant and largest current.
 */
#include <stdio.h>

#include "dyn_capi.h"

int main(void)
{
    const dyn_model model = { .struct_size = sizeof model, .kind = DYN_MODEL_KIND_BAKED };
    dyn_limits limits = { .struct_size = sizeof limits };
    dyn_voice_coils coils = { .struct_size = sizeof coils };

    if (dyn_model_limits(&model, &limits, NULL) != DYN_STATUS_OK
        || dyn_model_voice_coils(&model, &coils, NULL) != DYN_STATUS_OK) {
        return 1;
    }
    printf("%s %g %g %g\n", dyn_baked_platform_name(), (double)limits.maximum_force[0], (double)coils.force_constant[0],
           (double)coils.maximum_current[0]);
    return 0;
}
