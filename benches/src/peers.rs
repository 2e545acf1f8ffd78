//! Other people's code for the same functions: C by CasADi and Pinocchio in C++, compiled by `cargo xtask bench` and linked by
//! the feature `peers` (`build.rs`). Without it, or where a compiler is missing, the tables here are empty: absent peers
//! are not measured and nothing passes for them.
//!
//! This is the one module of the crate with `unsafe`: it calls functions of another language, whose promises are in the
//! comment of each call.
#![allow(unsafe_code)]

use std::ffi::c_void;

use crate::call::Call;
use crate::output::Output;
use crate::states::{COUNT, Inputs};

/// The compiled C of one function: addresses of inputs, addresses of outputs (a single one, everything row-major).
type Entry = unsafe extern "C" fn(*const *const f64, *const *mut f64);

/// A peer written in C by CasADi.
pub struct Peer {
    /// One of [`FUNCTIONS`](crate::cases::FUNCTIONS).
    pub function: &'static str,
    /// One of [`IMPLEMENTATIONS`](crate::cases::IMPLEMENTATIONS).
    pub implementation: &'static str,
    /// How the linear system is written out, compiler and flags.
    pub variant: &'static str,
    entry: Entry,
}

include!(concat!(env!("OUT_DIR"), "/peers.rs"));

impl Peer {
    /// All that are linked.
    pub fn all() -> &'static [Self] {
        PEERS
    }

    /// As something to measure. `arguments` lists the addresses of the function's inputs, `O` holds its outputs.
    pub fn call<F, O: Output + Default, const N: usize>(&self, arguments: F) -> PeerCall<F, O>
    where
        F: Fn(&Inputs) -> [*const f64; N],
    {
        PeerCall { entry: self.entry, arguments, output: O::default() }
    }
}

/// A call of a [`Peer`].
pub struct PeerCall<F, O> {
    entry: Entry,
    arguments: F,
    output: O,
}

impl<F, O: Output, const N: usize> Call for PeerCall<F, O>
where
    F: Fn(&Inputs) -> [*const f64; N],
{
    type State = Inputs;
    type Output = O;

    #[inline(always)]
    fn call<R>(&mut self, state: &Inputs, read: impl FnOnce(&O) -> R) -> R {
        let arguments = (self.arguments)(state);
        let results = [(&raw mut self.output).cast::<f64>()];
        // SAFETY: CasADi's function reads the arrays of its inputs, which `arguments` takes from `state` in the order of the
        // same table of functions, and writes its outputs, as many numbers as `O`, an array of f64, holds
        // (`cases::Cases::peers` pairs them). It keeps no address and has no state.
        unsafe { (self.entry)(arguments.as_ptr(), results.as_ptr()) };
        read(&self.output)
    }
}

/// A state for Pinocchio, which looks joint coordinates and speeds up by index: working them out is not measured.
#[derive(Clone, Copy)]
pub struct IndexedState {
    index: usize,
    inputs: Inputs,
}

/// Pinocchio's constrained forward dynamics of one mechanism at given states.
pub struct Pinocchio {
    peer: *mut c_void,
    output: [f64; 6],
}

impl Pinocchio {
    /// The mechanism with the platform's numbers, and the states; nothing if Pinocchio is not linked.
    pub fn new(
        platform: &dyn_platform::Platform,
        states: &[Inputs; COUNT],
    ) -> Option<(Self, Box<[IndexedState; COUNT]>)> {
        let functions = PINOCCHIO.as_ref()?;
        let numbers = pinocchio_numbers(platform);
        // SAFETY: `pinocchio_new` reads the numbers of `Numbers` in benches/peers/pinocchio_peer.cpp, which
        // `pinocchio_numbers` lists in that order, and COUNT states of the layout that `Inputs` has (`repr(C)`).
        let peer = unsafe { (functions.new)(numbers.as_ptr(), states.as_ptr().cast(), COUNT) };
        let states = std::array::from_fn(|index| IndexedState { index, inputs: states[index] });
        Some((Self { peer, output: [0.0; 6] }, Box::new(states)))
    }
}

impl Call for Pinocchio {
    type State = IndexedState;
    type Output = [f64; 6];

    #[inline(always)]
    fn call<R>(&mut self, state: &IndexedState, read: impl FnOnce(&[f64; 6]) -> R) -> R {
        if let Some(functions) = &PINOCCHIO {
            // SAFETY: `peer` comes from `pinocchio_new` and is released in `drop` alone; it knows as many states as have
            // an index; it reads one state and writes six numbers.
            unsafe {
                (functions.forward_dynamics)(
                    self.peer,
                    (&raw const state.inputs).cast(),
                    state.index,
                    self.output.as_mut_ptr(),
                );
            }
        }
        read(&self.output)
    }
}

impl Drop for Pinocchio {
    fn drop(&mut self) {
        if let Some(functions) = &PINOCCHIO {
            // SAFETY: `peer` comes from `pinocchio_new` and nobody else has it.
            unsafe { (functions.free)(self.peer) };
        }
    }
}

/// The entries of benches/peers/pinocchio_peer.cpp.
struct PinocchioFunctions {
    new: unsafe extern "C" fn(*const f64, *const f64, usize) -> *mut c_void,
    forward_dynamics: unsafe extern "C" fn(*mut c_void, *const f64, usize, *mut f64),
    free: unsafe extern "C" fn(*mut c_void),
}

/// Numbers of the mechanism in the order of `Numbers` in benches/peers/pinocchio_peer.cpp.
fn pinocchio_numbers(platform: &dyn_platform::Platform) -> Vec<f64> {
    let parameter = |name: &str| platform.parameter(name).expect("platforms have every parameter");
    let vectors = ["base_point", "actuator_axis", "platform_point"].map(parameter);
    let scalars = [
        "rod_length",
        "rod_mass",
        "rod_inertia",
        "rod_com_fraction",
        "mover_mass",
        "mover_offset",
        "rest_length",
        "axial_stiffness",
        "axial_damping",
    ]
    .map(parameter);
    let mut numbers = Vec::new();
    for leg in 0..6 {
        vectors.iter().for_each(|vector| numbers.extend(&vector[3 * leg..3 * leg + 3]));
        numbers.extend(scalars.iter().map(|scalar| scalar[leg]));
    }
    for name in ["payload_mass", "payload_com", "payload_inertia", "gravity"] {
        numbers.extend(parameter(name));
    }
    numbers
}
