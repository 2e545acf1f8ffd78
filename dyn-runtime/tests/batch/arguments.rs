//! What batches refuse, and that only the state concerned notices.

use dyn_runtime::batch::{Batch, Column, ColumnMut, LengthError};
use dyn_runtime::lanes::Instructions;
use dyn_runtime::models::Uhp2016;
use dyn_runtime::{Error, Input};

use crate::inputs::{Inputs, inverse};
use crate::platforms::platforms;

#[test]
fn bad_states_are_named_and_leave_their_neighbours_alone() {
    let sound = Inputs::<f64>::new(30);
    let (expected, _) = inverse(Batch::new(&Uhp2016), &sound);
    let mut inputs = sound.clone();
    inputs.sixes[3][9][2] = f64::NAN;
    inputs.sixes[0][10][5] = f64::INFINITY;
    inputs.rotations[1][29][4] = f64::NAN;
    let refused = [
        (9, Error::NonFinite { input: Input::PlatformAcceleration, element: 2 }),
        (10, Error::NonFinite { input: Input::BaseVelocity, element: 5 }),
        (29, Error::NonFinite { input: Input::PlatformRotation, element: 4 }),
    ];
    inputs.positions[1][4][0] += 0.3;
    for instructions in Instructions::available() {
        let (forces, status) = inverse(Batch::new(&Uhp2016).with_instructions(instructions), &inputs);
        for (state, reason) in refused {
            assert_eq!(status[state], Err(reason), "{}", instructions.name());
        }
        assert!(matches!(status[4], Err(Error::OutOfReach { .. })), "{:?}", status[4]);
        for (state, found) in forces.iter().enumerate() {
            if status[state].is_err() {
                assert_eq!(found, &[-7.0; 6], "untouched");
            } else if instructions == Instructions::widest() {
                assert_eq!(found, &expected[state], "{state}");
            }
        }
        let refused = status.iter().filter(|status| status.is_err()).count();
        assert_eq!(refused, 4);
    }
}

#[test]
fn an_argument_of_another_length_is_named() {
    let inputs = Inputs::<f64>::new(5);
    let forces = [[0.0; 6]; 4];
    let mut out = [[0.0; 6]; 5];
    let mut status = [Ok(()); 5];
    let batch = Batch::new(&Uhp2016);
    let refused = |argument, found| Err(LengthError { argument, expected: 5, found });

    let short = Column::states(&forces);
    let out = ColumnMut::states(&mut out);
    let said = batch.forward_dynamics(&inputs.states(), short, inputs.six(4), out, &mut status);
    assert_eq!(said, refused("actuator_force", 4));
    assert_eq!(
        said.unwrap_err().to_string(),
        "actuator_force holds 4 states, but status has room for 5; give every argument as many"
    );

    let mut states = inputs.states();
    states.platform.rotation = Column::states(&inputs.rotations[1][..3]);
    let mut few = [[0.0; 6]; 5];
    let mut call = |states, out: &mut [[f64; 6]]| {
        batch.inverse_dynamics(states, inputs.six(3), inputs.six(4), ColumnMut::states(out), &mut status)
    };
    assert_eq!(call(&states, &mut few), refused("platform.rotation", 3));
    assert_eq!(call(&inputs.states(), &mut few[..2]), refused("actuator_force", 2));

    let models = platforms(6);
    let said = Batch::of_models(&models).examine(&inputs.states(), &mut status);
    assert_eq!(said, refused("models", 6));
    let numbers = [0.0; 31];
    let odd = Column::component_major(&numbers);
    let mut out = [[0.0; 6]; 5];
    let out = ColumnMut::states(&mut out);
    let said = batch.inverse_dynamics(&inputs.states(), odd, inputs.six(4), out, &mut status);
    assert!(said.is_err(), "31 numbers are not five times six");
}

#[test]
fn no_states_are_no_work() {
    let (forces, status) = inverse(Batch::new(&Uhp2016), &Inputs::<f64>::new(0));
    assert!(forces.is_empty() && status.is_empty());
}

#[test]
fn examining_finds_what_a_hexapod_refuses() {
    let mut inputs = Inputs::<f64>::new(3);
    inputs.rotations[0][1][0] += 0.1;
    let mut status = [Ok(()); 3];
    Batch::new(&Uhp2016).examine(&inputs.states(), &mut status).expect("lengths");
    assert_eq!((status[0], status[2]), (Ok(()), Ok(())));
    assert!(
        matches!(status[1], Err(Error::NotARotation { input: Input::BaseRotation, .. })),
        "{:?}",
        status[1]
    );
}
