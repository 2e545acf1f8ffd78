//! What the library computes for the test vectors, as JSON on standard output: for comparison with the same library on
//! another machine. Structs appear as the numbers that follow their `struct_size`, in the header's order.

// C's own interface, called as C calls it.
#![allow(unsafe_code)]

use std::error::Error;
use std::mem::size_of;
use std::path::Path;
use std::ptr::{null, null_mut};

use dyn_capi as capi;
use dyn_capi::{Inputs, Model, ModelKind, Real, Status, UhpParameters, UpsParameters};
use dyn_platform::{LegType, Platform};
use serde_json::{Map, Value, json};

/// Calls functions of the interface; name, whether the output is a struct, and its numbers.
macro_rules! outputs {
    ($model:ident, $inputs:ident; $($function:ident: $output:ty),+ $(,)?) => {{
        let mut outputs = Map::new();
        $({
            const NUMBERS: usize = numbers::<$output>();
            let mut place = [Real::NAN; NUMBERS + HEADER];
            let output: *mut $output = if is_structure::<$output>() {
                // SAFETY: the place is as large as the struct and aligned like it.
                unsafe { place.as_mut_ptr().cast::<usize>().write(size_of::<$output>()) };
                place.as_mut_ptr().cast()
            } else {
                place[HEADER..].as_mut_ptr().cast()
            };
            // SAFETY: model and inputs live, the output has its size.
            let status = unsafe { capi::$function(&$model, &$inputs, output, null_mut()) };
            if status != Status::Ok {
                return Err(format!("{}: {status:?}", stringify!($function)).into());
            }
            outputs.insert(
                stringify!($function).into(),
                json!({ "structure": is_structure::<$output>(), "numbers": place[HEADER..] }),
            );
        })+
        outputs
    }};
}

/// Numbers in the place of `struct_size`.
const HEADER: usize = size_of::<usize>() / size_of::<Real>();

/// Arrays are as large as their numbers; structs have one member more.
const fn is_structure<T>() -> bool {
    let numbers = size_of::<T>() / size_of::<Real>();
    // 6 and 36 numbers are the only arrays.
    numbers != 6 && numbers != 36
}

const fn numbers<T>() -> usize {
    size_of::<T>() / size_of::<Real>() - if is_structure::<T>() { HEADER } else { 0 }
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/vectors");
    let mut files: Vec<_> = std::fs::read_dir(folder)?.flatten().map(|entry| entry.path()).collect();
    files.sort();
    let mut platforms = Vec::new();
    for file in files {
        let vectors: Value = serde_json::from_str(&std::fs::read_to_string(file)?)?;
        let platform: Platform = serde_json::from_value(vectors["platform"].clone())?;
        let cases = vectors["cases"].as_array().ok_or("no cases")?;
        let kind = match platform.leg_type {
            LegType::Uhp => ModelKind::Uhp,
            LegType::Ups => ModelKind::Ups,
        };
        platforms.push(run(&platform, cases, kind)?);
        if platform.name == "uhp_2016" {
            platforms.push(run(&platform, cases, ModelKind::Baked)?);
        }
    }
    println!("{}", json!({ "platforms": platforms }));
    Ok(())
}

fn run(platform: &Platform, cases: &[Value], kind: ModelKind) -> Result<Value, Box<dyn Error>> {
    let numbers = numbers_of(platform)?;
    // Only the struct of the platform's leg type takes these numbers.
    let uhp: Option<UhpParameters> = structure(&numbers).ok();
    let ups: Option<UpsParameters> = structure(&numbers).ok();
    let model = Model {
        struct_size: size_of::<Model>(),
        kind: kind as i32,
        uhp: uhp.as_ref().map_or(null(), |parameters| parameters),
        ups: ups.as_ref().map_or(null(), |parameters| parameters),
    };
    let mut results = Vec::new();
    for case in cases {
        let inputs = inputs(case)?;
        let outputs = outputs!(model, inputs;
            dyn_rod_alignment: [Real; 6],
            dyn_leg_kinematics: capi::LegKinematics,
            dyn_jacobian_dp: [[Real; 6]; 6],
            dyn_jacobian_db: [[Real; 6]; 6],
            dyn_mass_matrix_p: [[Real; 6]; 6],
            dyn_mass_matrix_b: [[Real; 6]; 6],
            dyn_coriolis_matrices: capi::CoriolisMatrices,
            dyn_stiffness_matrices: capi::StiffnessMatrices,
            dyn_matrices: capi::Matrices,
            dyn_passive_forces: capi::PassiveForces,
            dyn_bias: [Real; 6],
            dyn_equation_of_motion: capi::EquationOfMotion,
            dyn_inverse_dynamics: [Real; 6],
            dyn_forward_dynamics: [Real; 6],
            dyn_energy: capi::Energy,
            dyn_control: capi::Control,
            dyn_passive_inverse_dynamics: [Real; 6],
            dyn_base_reaction: [Real; 6],
        );
        results.push(json!({ "inputs": words(&inputs), "outputs": outputs }));
    }
    Ok(json!({ "name": platform.name, "kind": kind as i32, "parameters": numbers, "cases": results }))
}

/// The numbers of a struct after its size.
fn words<T>(structure: &T) -> Vec<Real> {
    let start: *const Real = (&raw const *structure).cast();
    // SAFETY: interface structs hold numbers only, after a `usize` that is as large as HEADER of them.
    (HEADER..size_of::<T>() / size_of::<Real>()).map(|index| unsafe { start.add(index).read() }).collect()
}

/// A struct of the interface from the numbers after its size.
fn structure<T: Copy>(numbers: &[Real]) -> Result<T, Box<dyn Error>> {
    let mut words = vec![0.0; HEADER];
    words.extend_from_slice(numbers);
    if words.len() * size_of::<Real>() != size_of::<T>() {
        return Err(format!("{} numbers for {} bytes", numbers.len(), size_of::<T>()).into());
    }
    let start = words.as_mut_ptr();
    // SAFETY: as many bytes as the struct has, aligned for its `usize`, which is as large as HEADER numbers; any bits
    // are numbers.
    unsafe {
        start.cast::<usize>().write(size_of::<T>());
        Ok(start.cast::<T>().read())
    }
}

/// The parameters in the order of the struct, which is that of the platform's own table.
fn numbers_of(platform: &Platform) -> Result<Vec<Real>, Box<dyn Error>> {
    let mut numbers = Vec::new();
    for name in platform.parameter_names() {
        numbers.extend(platform.parameter(name).ok_or(name)?);
    }
    Ok(numbers)
}

/// In the order of the struct.
fn inputs(case: &Value) -> Result<Inputs, Box<dyn Error>> {
    let mut numbers = Vec::new();
    for body in ["base", "platform"] {
        for part in ["position", "rotation", "velocity", "acceleration"] {
            flatten(&case[body][part], &mut numbers);
        }
    }
    // The reference's velocity is the platform's.
    flatten(&case["platform"]["velocity"], &mut numbers);
    flatten(&case["actuator_force"], &mut numbers);
    flatten(&case["external_wrench"], &mut numbers);
    structure(&numbers)
}

fn flatten(value: &Value, numbers: &mut Vec<Real>) {
    match value {
        Value::Array(elements) => elements.iter().for_each(|element| flatten(element, numbers)),
        number => numbers.extend(number.as_f64()),
    }
}
