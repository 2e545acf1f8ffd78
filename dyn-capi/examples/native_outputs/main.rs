//! What the library computes for the test vectors and for what is derived from them, by every function of the header that gives a
//! status, as JSON on standard output: for comparison with the same library on another machine. Structs appear as the numbers that
//! follow their `struct_size`, in the header's order, and the integers after those.

// C's own interface, called as C calls it.
#![allow(unsafe_code)]

mod derived;

use std::collections::BTreeSet;
use std::error::Error;
use std::mem::size_of;
use std::path::Path;
use std::ptr::null;

use dyn_capi as capi;
use dyn_capi::{Coils, Info, Inputs, LegKinematics, Limits, Model, ModelKind, Real, Status};
use dyn_platform::{LegType, Platform};
use serde_json::{Value, json};

use derived::Derived;

/// What a call writes.
trait Output {
    /// Whether it begins with its size.
    const IS_STRUCTURE: bool;
    /// Integers after its numbers.
    const INTEGERS: usize = 0;
}

impl<const N: usize> Output for [Real; N] {
    const IS_STRUCTURE: bool = false;
}

impl<const N: usize, const M: usize> Output for [[Real; N]; M] {
    const IS_STRUCTURE: bool = false;
}

/// Structs, and how many integers they end with.
macro_rules! structures {
    ($($structure:ident: $integers:literal),+ $(,)?) => {$(
        impl Output for capi::$structure {
            const IS_STRUCTURE: bool = true;
            const INTEGERS: usize = $integers;
        }
    )+};
}

structures!(
    LegKinematics: 0,
    CoriolisMatrices: 0,
    StiffnessMatrices: 0,
    Matrices: 0,
    PassiveForces: 0,
    EquationOfMotion: 0,
    Energy: 0,
    Control: 0,
    ForwardKinematics: 1,
    Limits: 0,
    Coils: 0,
    Margins: 6,
    CurrentsResult: 1,
);

/// What goes into a call, and how the comparison puts it there.
struct Argument<T> {
    pointer: *const T,
    description: Value,
}

impl<T> Argument<T> {
    /// The model or the inputs of the case.
    fn named(name: &str, structure: &T) -> Self {
        Self { pointer: structure, description: json!(name) }
    }

    /// A struct of numbers.
    fn structure(structure: &T) -> Self {
        Self { pointer: structure, description: json!({ "structure": true, "numbers": words(structure) }) }
    }
}

impl Argument<Real> {
    fn numbers(numbers: &[Real]) -> Self {
        Self { pointer: numbers.as_ptr(), description: json!({ "structure": false, "numbers": numbers }) }
    }
}

/// Calls functions of the interface and adds what comes out to a list. Without output: `()`.
macro_rules! calls {
    ($list:expr; $($function:ident($($argument:expr),*): $output:ty),+ $(,)?) => {$(
        let mut info = details();
        let mut place = Place::new::<$output>();
        // SAFETY: arguments live, the output has its size.
        let status = unsafe { capi::$function($($argument.pointer,)* place.start::<$output>(), &mut info) };
        let arguments = json!([$($argument.description),*]);
        $list.push(record(stringify!($function), arguments, status, &info, place.read::<$output>(status)));
    )+};
}

/// Calls functions without output.
macro_rules! questions {
    ($list:expr; $($function:ident($($argument:expr),*)),+ $(,)?) => {$(
        let mut info = details();
        // SAFETY: arguments live.
        let status = unsafe { capi::$function($($argument.pointer,)* &mut info) };
        let arguments = json!([$($argument.description),*]);
        $list.push(record(stringify!($function), arguments, status, &info, Value::Null));
    )+};
}

fn details() -> Info {
    Info {
        struct_size: size_of::<Info>(),
        input: capi::InputName::None,
        element: -1,
        leg: -1,
        quantity: -1,
        value: 0.0,
        limit: 0.0,
    }
}

/// One call with all that came of it.
fn record(name: &str, arguments: Value, status: Status, info: &Info, output: Value) -> Value {
    json!({
        "name": name,
        "arguments": arguments,
        "status": status as i32,
        "details": {
            "integers": [info.input as i32, info.element, info.leg, info.quantity],
            "numbers": [number(&info.value), number(&info.limit)],
        },
        "output": output,
    })
}

/// Where an output goes.
struct Place(Vec<u64>);

impl Place {
    fn new<O: Output>() -> Self {
        let mut words = vec![u64::MAX; size_of::<O>().div_ceil(8)];
        if O::IS_STRUCTURE {
            words[0] = size_of::<O>() as u64;
        }
        Self(words)
    }

    fn start<O>(&mut self) -> *mut O {
        self.0.as_mut_ptr().cast()
    }

    /// What the output is, and what has been written there, if anything has.
    fn read<O: Output>(&self, status: Status) -> Value {
        let header = if O::IS_STRUCTURE { HEADER } else { 0 };
        let end = (size_of::<O>() - (4 * O::INTEGERS).next_multiple_of(8)) / size_of::<Real>();
        let shape = json!({ "structure": O::IS_STRUCTURE, "numbers": end - header, "integers": O::INTEGERS });
        if status != Status::Ok {
            return json!({ "shape": shape, "numbers": [], "integers": [] });
        }
        let start = self.0.as_ptr().cast::<Real>();
        // SAFETY: the library has written numbers up to `end` and integers from there.
        let (numbers, integers) = unsafe {
            let numbers: Vec<Value> = (header..end).map(|index| number(&*start.add(index))).collect();
            (numbers, std::slice::from_raw_parts(start.add(end).cast::<i32>(), O::INTEGERS))
        };
        json!({ "shape": shape, "numbers": numbers, "integers": integers })
    }
}

/// Infinite ones, which JSON does not have, as JavaScript writes them.
fn number(number: &Real) -> Value {
    match *number {
        Real::INFINITY => json!("Infinity"),
        Real::NEG_INFINITY => json!("-Infinity"),
        finite => json!(finite),
    }
}

/// Numbers in the place of `struct_size`.
const HEADER: usize = size_of::<usize>() / size_of::<Real>();

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
    assert_complete(&platforms)?;
    println!("{}", json!({ "platforms": platforms }));
    Ok(())
}

fn run(platform: &Platform, cases: &[Value], kind: ModelKind) -> Result<Value, Box<dyn Error>> {
    let numbers = numbers_of(platform)?;
    // Only the struct of the platform's leg type takes these numbers.
    let uhp: Option<capi::UhpParameters> = structure(&numbers).ok();
    let ups: Option<capi::UpsParameters> = structure(&numbers).ok();
    let model = Model {
        struct_size: size_of::<Model>(),
        kind: kind as i32,
        uhp: uhp.as_ref().map_or(null(), |parameters| parameters),
        ups: ups.as_ref().map_or(null(), |parameters| parameters),
    };
    let mut results = Vec::new();
    for case in cases {
        let inputs = inputs(case)?;
        results.push(json!({ "inputs": words(&inputs), "calls": calls_at(&model, &inputs)? }));
    }
    Ok(json!({ "name": platform.name, "kind": kind as i32, "parameters": numbers, "cases": results }))
}

/// Every function, at one state.
fn calls_at(model: &Model, inputs: &Inputs) -> Result<Vec<Value>, Box<dyn Error>> {
    let mut list = Vec::new();
    let model = Argument::named("model", model);
    let derived = Derived::of(model.pointer, inputs)?;
    let inputs = Argument::named("inputs", inputs);
    calls!(list;
        dyn_rod_alignment(model, inputs): [Real; 6],
        dyn_leg_kinematics(model, inputs): LegKinematics,
        dyn_jacobian_dp(model, inputs): [[Real; 6]; 6],
        dyn_jacobian_db(model, inputs): [[Real; 6]; 6],
        dyn_mass_matrix_p(model, inputs): [[Real; 6]; 6],
        dyn_mass_matrix_b(model, inputs): [[Real; 6]; 6],
        dyn_coriolis_matrices(model, inputs): capi::CoriolisMatrices,
        dyn_stiffness_matrices(model, inputs): capi::StiffnessMatrices,
        dyn_matrices(model, inputs): capi::Matrices,
        dyn_passive_forces(model, inputs): capi::PassiveForces,
        dyn_bias(model, inputs): [Real; 6],
        dyn_equation_of_motion(model, inputs): capi::EquationOfMotion,
        dyn_inverse_dynamics(model, inputs): [Real; 6],
        dyn_forward_dynamics(model, inputs): [Real; 6],
        dyn_energy(model, inputs): capi::Energy,
        dyn_control(model, inputs): capi::Control,
        dyn_passive_inverse_dynamics(model, inputs): [Real; 6],
        dyn_base_reaction(model, inputs): [Real; 6],
    );
    if let Some(refused) = list.iter().find(|call| call["status"] != 0) {
        return Err(format!("a test vector is refused: {refused}").into());
    }

    let start = Argument::structure(&derived.start);
    let (lengths, rates) = (Argument::numbers(&derived.lengths), Argument::numbers(&derived.rates));
    let (limits, coils) = (Argument::structure(&derived.limits), Argument::structure(&derived.coils));
    let forces = Argument::numbers(&derived.forces);
    let (angles, speeds) = (Argument::numbers(&derived.angles), Argument::numbers(&derived.speeds));
    let quaternion = Argument::numbers(&derived.quaternion);
    calls!(list;
        dyn_forward_kinematics(model, start, lengths): capi::ForwardKinematics,
        dyn_platform_velocity(model, inputs, rates): [Real; 6],
        dyn_monitor(model, inputs, limits): capi::Margins,
        dyn_currents(coils, forces): capi::CurrentsResult,
        dyn_model_limits(model): Limits,
        dyn_model_voice_coils(model): Coils,
        dyn_rotation_from_quaternion(quaternion): [[Real; 3]; 3],
        dyn_rotation_from_angles(angles): [[Real; 3]; 3],
        dyn_angular_velocity(angles, speeds): [Real; 3],
        dyn_angle_rates(angles, speeds): [Real; 3],
    );
    questions!(list; dyn_check_model(model), dyn_check_limits(model, inputs, limits));
    Ok(list)
}

/// Every function of the header that gives a status is among the calls.
fn assert_complete(platforms: &[Value]) -> Result<(), Box<dyn Error>> {
    let header = include_str!("../../include/dyn_capi.h");
    let functions = header.lines().filter_map(|line| line.strip_prefix("dyn_status "));
    let functions: BTreeSet<&str> = functions.filter_map(|line| line.split('(').next()).collect();
    for platform in platforms {
        let calls = platform["cases"][0]["calls"].as_array().ok_or("no calls")?;
        let called: BTreeSet<&str> = calls.iter().filter_map(|call| call["name"].as_str()).collect();
        if called != functions {
            return Err(format!("not called: {:?}", functions.difference(&called)).into());
        }
    }
    Ok(())
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
