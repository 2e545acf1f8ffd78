//! Matrices of many states.

use dyn_runtime::batch::{Batch, ColumnMut};
use dyn_runtime::lanes::Instructions;
use dyn_runtime::models::{Uhp2016, uhp_2016};

use crate::inputs::{Inputs, rows};

#[test]
fn matrices_are_those_of_a_single_state() {
    let inputs = Inputs::<f64>::new(11);
    for instructions in Instructions::available() {
        let mut matrices: [Vec<[f64; 36]>; 6] = std::array::from_fn(|_| vec![[0.0; 36]; 11]);
        let mut status = vec![Ok(()); 11];
        let out = matrices.each_mut().map(|matrices| ColumnMut::states(matrices)).into();
        let batch = Batch::new(&Uhp2016).with_instructions(instructions);
        batch.matrices(&inputs.states(), out, &mut status).expect("lengths");
        for state in 0..11 {
            let [mut a, mut b, mut c, mut d, mut e, mut f] = [[[0.0; 6]; 6]; 6];
            let (position, rotation) = (&inputs.positions, &inputs.rotations);
            uhp_2016::matrices(
                &position[0][state],
                &rows(rotation[0][state]),
                &inputs.sixes[0][state],
                &position[1][state],
                &rows(rotation[1][state]),
                &inputs.sixes[2][state],
                &mut a,
                &mut b,
                &mut c,
                &mut d,
                &mut e,
                &mut f,
            );
            for (found, expected) in matrices.iter().zip([a, b, c, d, e, f]) {
                let size = expected.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                for (found, expected) in found[state].iter().zip(expected.as_flattened()) {
                    assert!((found - expected).abs() <= 1e-14 * size, "{state}: {found} {expected}");
                }
            }
        }
    }
}
