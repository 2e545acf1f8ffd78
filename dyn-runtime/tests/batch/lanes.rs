//! Every lane of every set of instructions has the bits of a single number, wherever the numbers lie.

use dyn_runtime::batch::{Batch, Column, ColumnMut};
use dyn_runtime::kernels::{self, generic};
use dyn_runtime::lanes::{Instructions, Kernel, Lanes};
use dyn_runtime::models::{Uhp, Uhp2016};
use dyn_runtime::solve::solve_after_attempt;

use crate::fused::{Fused, FusedMultiplyAdd};
use crate::inputs::{Inputs, inverse, rows};
use crate::platforms::{in_fused, platforms};

/// A generic function with three numbers of poses and five sixes, at one state, in numbers of type T.
macro_rules! alone {
    ($model:ty, $kernel:ident, $function:ident, $inputs:expr, $state:expr, $parameters:expr, $wrap:expr, $unwrap:expr) => {{
        let (inputs, state) = ($inputs, $state);
        let position = |k: usize| inputs.positions[k][state].map($wrap);
        let rotation = |k: usize| rows(inputs.rotations[k][state].map($wrap));
        let six = |k: usize| inputs.sixes[k][state].map($wrap);
        let mut result = [$wrap(Default::default()); 6];
        <$model as generic::$kernel>::$function(
            $parameters,
            &position(0),
            &rotation(0),
            &six(0),
            &six(1),
            &position(1),
            &rotation(1),
            &six(2),
            &six(3),
            &six(4),
            &mut result,
        );
        result.map($unwrap)
    }};
}

/// One state of the baked model, with the rounding of these instructions.
fn inverse_alone<S: FusedMultiplyAdd>(inputs: &Inputs<S>, state: usize, fused: bool) -> [S; 6] {
    match fused {
        true => {
            alone!(Uhp2016, InverseDynamics, inverse_dynamics, inputs, state, &(), Fused, |x: Fused<S>| x.0)
        }
        false => alone!(Uhp2016, InverseDynamics, inverse_dynamics, inputs, state, &(), |x: S| x, |x: S| x),
    }
}

fn every_lane_has_the_bits_of_a_single_number<S: FusedMultiplyAdd>()
where
    Uhp2016: kernels::RodAlignment<S>,
{
    // Two whole groups of the widest lanes and a tail.
    let inputs = Inputs::<S>::new(39);
    for instructions in Instructions::available() {
        let (forces, status) = inverse(Batch::new(&Uhp2016).with_instructions(instructions), &inputs);
        assert!(status.iter().all(Result::is_ok), "{status:?}");
        for (state, found) in forces.iter().enumerate() {
            let expected = inverse_alone(&inputs, state, instructions.fused());
            assert_eq!(found, &expected, "{} of {}", state, instructions.name());
        }
    }
}

#[test]
fn every_lane_has_the_bits_of_a_single_f64() {
    every_lane_has_the_bits_of_a_single_number::<f64>();
}

#[test]
fn every_lane_has_the_bits_of_a_single_f32() {
    every_lane_has_the_bits_of_a_single_number::<f32>();
}

#[test]
fn this_processor_s_instructions_are_in_order() {
    let names: Vec<_> = Instructions::available().map(Instructions::name).collect();
    assert_eq!(names.last(), Some(&"portable"));
    assert_eq!(names[0], Instructions::widest().name());
}

/// A solution that is known in every other lane: there it stays as it is, elsewhere elimination finds it.
struct Attempts;

impl Kernel<f64> for Attempts {
    type Output = ();

    fn run<T: Lanes<Number = f64>>(self) {
        let exact = |row: usize, lane: usize| (row + 1) as f64 / (2 + lane) as f64;
        let known = |row: usize, lane: usize| exact(row, lane) * (1.0 + 8.0 * f64::EPSILON);
        let (mut matrix, mut right) = ([[T::constant(0.0); 6]; 6], [T::constant(0.0); 6]);
        let mut attempt = right;
        for row in 0..6 {
            // Rows have to be exchanged.
            let equation = (row + 1) % 6;
            matrix[equation][row] = T::from_fn(|lane| (2 + lane) as f64);
            right[equation] = T::splat((row + 1) as f64);
            attempt[row] = T::from_fn(|lane| if lane % 2 == 0 { known(row, lane) } else { 7.5 });
        }
        for (row, numbers) in solve_after_attempt(&attempt, &matrix, &right).into_iter().enumerate() {
            numbers.for_each(|lane, number| {
                if lane % 2 == 0 {
                    assert_eq!(number, known(row, lane));
                } else {
                    let error = (number / exact(row, lane) - 1.0).abs();
                    assert!(error <= 4.0 * f64::EPSILON, "{row}, {lane}: {number}");
                }
            });
        }
    }
}

#[test]
fn each_lane_keeps_its_attempt_or_is_solved() {
    for instructions in Instructions::available() {
        instructions.run(Attempts);
    }
}

#[test]
fn every_lane_may_have_a_platform_of_its_own() {
    let inputs = Inputs::<f64>::new(21);
    let models = platforms(21);
    for instructions in Instructions::available() {
        let (forces, status) = inverse(Batch::of_models(&models).with_instructions(instructions), &inputs);
        assert!(status.iter().all(Result::is_ok), "{status:?}");
        for (state, (found, model)) in forces.iter().zip(&models).enumerate() {
            let expected = if instructions.fused() {
                let parameters = in_fused(&model.parameters);
                alone!(
                    Uhp,
                    InverseDynamics,
                    inverse_dynamics,
                    &inputs,
                    state,
                    &parameters,
                    Fused,
                    |x: Fused<f64>| x.0
                )
            } else {
                let plain = |x: f64| x;
                alone!(
                    Uhp,
                    InverseDynamics,
                    inverse_dynamics,
                    &inputs,
                    state,
                    &model.parameters,
                    plain,
                    plain
                )
            };
            assert_eq!(found, &expected, "{} of {}", state, instructions.name());
        }
        let (same, _) = inverse(Batch::new(&models[0]).with_instructions(instructions), &inputs);
        assert_eq!(same[0], forces[0]);
        assert_ne!(same[1], forces[1]);
    }
}

#[test]
fn layouts_give_the_same() {
    let inputs = Inputs::<f64>::new(29);
    let (expected, _) = inverse(Batch::new(&Uhp2016), &inputs);
    let component_major = |states: &[[f64; 6]]| -> Vec<f64> {
        (0..6).flat_map(|k| states.iter().map(move |state| state[k])).collect()
    };
    let acceleration = component_major(&inputs.sixes[3]);
    let wrench = component_major(&inputs.sixes[4]);
    let mut forces = vec![0.0; 6 * 29];
    let mut status = vec![Ok(()); 29];
    let wrench: [&[f64]; 6] = std::array::from_fn(|k| &wrench[29 * k..29 * (k + 1)]);
    Batch::new(&Uhp2016)
        .inverse_dynamics(
            &inputs.states(),
            Column::component_major(&acceleration),
            Column::components(wrench),
            ColumnMut::component_major(&mut forces),
            &mut status,
        )
        .expect("lengths");
    assert_eq!(forces, component_major(&expected));
}
