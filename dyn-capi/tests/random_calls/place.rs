//! Places for outputs, as a caller has them: filled with a pattern, guarded on both sides.

use std::fmt::Debug;
use std::marker::PhantomData;
use std::mem::{align_of, size_of};
use std::ptr::null_mut;

use dyn_capi as capi;
use dyn_capi::{Info, InputName, Real, Status};

use crate::source::Source;

/// What stands where nothing has been written; as numbers they are finite.
const PATTERN: u64 = 0x2bad_2bad_2bad_2bad;

/// What a call writes.
pub trait Output: Copy + Debug {
    /// Whether it begins with its size.
    const IS_STRUCTURE: bool;

    /// Every number may stand there with `DYN_STATUS_OK`.
    fn is_good(&self) -> bool;
}

impl<const N: usize> Output for [Real; N] {
    const IS_STRUCTURE: bool = false;

    fn is_good(&self) -> bool {
        self.iter().all(|number| number.is_finite())
    }
}

impl<const N: usize, const M: usize> Output for [[Real; N]; M] {
    const IS_STRUCTURE: bool = false;

    fn is_good(&self) -> bool {
        self.as_flattened().iter().all(|number| number.is_finite())
    }
}

/// Structs, and when they are good.
macro_rules! structures {
    ($($structure:ty: |$own:ident| $is_good:expr;)+) => {$(
        impl Output for $structure {
            const IS_STRUCTURE: bool = true;

            fn is_good(&self) -> bool {
                let $own = self;
                $own.struct_size == size_of::<Self>() && $is_good
            }
        }
    )+};
}

structures! {
    capi::CoriolisMatrices: |own| numbers(own).iter().all(|number| number.is_finite());
    capi::Energy: |own| numbers(own).iter().all(|number| number.is_finite());
    capi::EquationOfMotion: |own| numbers(own).iter().all(|number| number.is_finite());
    capi::LegKinematics: |own| numbers(own).iter().all(|number| number.is_finite());
    capi::Matrices: |own| numbers(own).iter().all(|number| number.is_finite());
    capi::PassiveForces: |own| numbers(own).iter().all(|number| number.is_finite());
    capi::StiffnessMatrices: |own| numbers(own).iter().all(|number| number.is_finite());
    capi::Control: |own| numbers(own).iter().all(|number| number.is_finite());
    // No limit is INFINITY.
    capi::Limits: |own| !numbers(own).iter().any(|number| number.is_nan());
    capi::Coils: |own| !numbers(own).iter().any(|number| number.is_nan());
    capi::Margins: |own| {
        let of_legs = own.leg[..5].iter().all(|leg| (0..6).contains(leg));
        !own.margin.iter().any(|margin| margin.is_nan()) && of_legs && own.leg[5] == -1
    };
    capi::CurrentsResult: |own| {
        own.current.is_good() && own.actuator_force.is_good() && (0.0..=1.0).contains(&own.factor)
            && (-1..6).contains(&own.saturated_leg)
    };
    capi::ForwardKinematics: |own| {
        own.platform_position.is_good() && own.platform_rotation.is_good() && own.residual.is_finite()
            && own.iterations <= 30
    };
    // 18 numbers are the largest input or parameter.
    Info: |own| {
        (-1..18).contains(&own.element) && (-1..6).contains(&own.leg) && (-1..6).contains(&own.quantity)
    };
}

/// The numbers after the size, of a struct that has nothing else.
fn numbers<T>(structure: &T) -> &[Real] {
    let count = (size_of::<T>() - size_of::<usize>()) / size_of::<Real>();
    let start = (&raw const *structure).cast::<usize>();
    // SAFETY: the rest of the struct is numbers, and `usize` is no less aligned than they are.
    unsafe { std::slice::from_raw_parts(start.add(1).cast(), count) }
}

/// A place, and whether its pointer or its size is one that the call refuses.
pub struct Place<O> {
    words: Vec<u64>,
    before: Vec<u64>,
    fault: Option<Fault>,
    output: PhantomData<O>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Fault {
    Null,
    Misaligned,
    WrongSize,
}

impl<O: Output> Place<O> {
    pub fn new(source: &mut Source) -> Self {
        assert!(align_of::<O>() <= align_of::<u64>());
        let fault = match source.one_of(400) {
            0 => Some(Fault::Null),
            1 => Some(Fault::Misaligned),
            2 if O::IS_STRUCTURE => Some(Fault::WrongSize),
            _ => None,
        };
        // A word before, two after.
        let mut words = vec![PATTERN; size_of::<O>().div_ceil(8) + 3];
        if O::IS_STRUCTURE {
            words[1] = size_of::<O>() as u64 + u64::from(fault == Some(Fault::WrongSize));
        }
        Self { before: words.clone(), words, fault, output: PhantomData }
    }

    pub fn pointer(&mut self) -> *mut O {
        match self.fault {
            Some(Fault::Null) => null_mut(),
            Some(Fault::Misaligned) => self.words[1..].as_mut_ptr().cast::<u8>().wrapping_add(1).cast(),
            Some(Fault::WrongSize) | None => self.words[1..].as_mut_ptr().cast(),
        }
    }

    /// Untouched, or good and the guards untouched.
    pub fn assert_left(&self, call: &str, status: Status) {
        if status != Status::Ok {
            assert_eq!(self.words, self.before, "{call}: {status:?}, and the output has changed");
            return;
        }
        assert!(self.fault.is_none(), "{call}: a bad pointer or size passes");
        let output = self.read(call);
        assert!(output.is_good(), "{call}: not every number may stand there, with {status:?}: {output:?}");
    }

    /// What has been written.
    fn read(&self, call: &str) -> O {
        let guards = |words: &[u64]| [words[0], words[words.len() - 2], words[words.len() - 1]];
        assert_eq!(guards(&self.words), guards(&self.before), "{call}: writes beside its output");
        // SAFETY: as large as the type and aligned for it, of numbers and enumerations that the library has written.
        unsafe { self.words[1..].as_ptr().cast::<O>().read() }
    }
}

impl Place<Info> {
    /// Details are written whatever the status, if they have a place.
    pub fn assert_details(&self, call: &str, status: Status) {
        match self.fault {
            // No details wanted.
            Some(Fault::Null) => {}
            Some(fault) => {
                let (is_misaligned, refusal) = (fault == Fault::Misaligned, status);
                let expected = if is_misaligned { Status::NullPointer } else { Status::WrongStructSize };
                assert_eq!(refusal, expected, "{call}: a bad place for details passes");
                assert_eq!(self.words, self.before, "{call}: a bad place for details has changed");
            }
            None => {
                let info = self.read(call);
                assert!(info.is_good(), "{call}: {info:?} with {status:?}");
                if status == Status::Ok {
                    assert!(
                        info.input == InputName::None && info.leg == -1,
                        "{call}: {info:?} with {status:?}"
                    );
                }
            }
        }
    }
}
