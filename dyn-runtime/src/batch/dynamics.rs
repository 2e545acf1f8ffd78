//! Inverse and forward dynamics of a batch.

use super::models::Models;
use super::states::{finite, reached, settle};
use super::{Column, ColumnMut, LengthError, States, Status};
use crate::error::Input;
use crate::kernels::{RodAlignment, generic};
use crate::lanes::{InLanes, Kernel, Lanes, Number};

macro_rules! dynamics {
    ($kernel:ident, $function:ident, input $input:ident: $input_name:ident, output $output:ident) => {
        pub(super) struct $kernel<'a, M, S> {
            pub models: Models<'a, M>,
            pub states: States<'a, S>,
            pub $input: Column<'a, S, 6>,
            pub external_wrench: Column<'a, S, 6>,
            pub $output: ColumnMut<'a, S, 6>,
            pub status: &'a mut [Status],
            /// Index of the first state in the inputs.
            pub offset: usize,
        }

        impl<M, S: Number> Kernel<S> for $kernel<'_, M, S>
        where
            M: InLanes<S> + RodAlignment<S> + generic::RodAlignment + generic::$kernel,
        {
            type Output = ();

            #[inline(always)]
            fn run<T: Lanes<Number = S>>(self) {
                let Self { models, states, $input, external_wrench, mut $output, status, offset } = self;
                if status.is_empty() {
                    return;
                }
                let mut parameters = models.load::<S, T>(offset);
                for first in (0..status.len()).step_by(T::COUNT) {
                    let input = offset + first;
                    models.reload::<S, T>(input, &mut parameters);
                    let (base, platform) = states.load::<T>(input);
                    let mut result = [T::constant(0.0); 6];
                    <M as generic::$kernel>::$function(
                        &parameters,
                        &base.position,
                        &base.rotation,
                        &base.velocity,
                        &base.acceleration,
                        &platform.position,
                        &platform.rotation,
                        &platform.velocity,
                        &$input.load(input),
                        &external_wrench.load(input),
                        &mut result,
                    );
                    let reached = reached::<M, T>(&parameters, &base, &platform);
                    let finite = finite(&result);
                    let kept = settle::<T>(&mut status[first..], reached & finite, finite, |lane| {
                        let state = input + lane;
                        states
                            .examined(
                                models.of(state),
                                state,
                                &[
                                    (Input::BaseAcceleration, states.base.acceleration.at(state)),
                                    (Input::$input_name, $input.at(state)),
                                    (Input::ExternalWrench, external_wrench.at(state)),
                                ],
                            )
                            .err()
                    });
                    $output.store(first, &result, kept);
                }
            }
        }

        impl<M, S: Number> super::Job<S> for $kernel<'_, M, S>
        where
            M: InLanes<S> + RodAlignment<S> + generic::RodAlignment + generic::$kernel + Sync,
        {
            fn count(&self) -> usize {
                self.status.len()
            }

            fn check(&self, count: usize) -> Result<(), LengthError> {
                self.models.check(count)?;
                self.states.check(count)?;
                self.$input.check(stringify!($input), count)?;
                self.external_wrench.check("external_wrench", count)?;
                self.$output.check(stringify!($output), count)
            }

            #[cfg(feature = "rayon")]
            fn split(self, state: usize) -> (Self, Self) {
                let ($output, after) = self.$output.split(state);
                let (status, status_after) = self.status.split_at_mut(state);
                let offset = self.offset + state;
                (
                    Self { $output, status, ..self },
                    Self { $output: after, status: status_after, offset, ..self },
                )
            }
        }
    };
}

dynamics!(
    InverseDynamics, inverse_dynamics,
    input platform_acceleration: PlatformAcceleration,
    output actuator_force
);

dynamics!(
    ForwardDynamics, forward_dynamics,
    input actuator_force: ActuatorForce,
    output platform_acceleration
);
