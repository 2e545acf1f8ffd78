//! Emitted files compiled by rustc and run.

use std::fmt::Write;
use std::process::Command;

use dyn_gen::graph::{Evaluator, Graph, Symbol};

/// The runtime crate as generated code sees it.
const RUNTIME: &str = "
mod float {
    use std::ops::{Add, Div, Mul, Neg, Sub};
    pub trait Scalar:
        Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
    {
        fn constant(value: f64) -> Self;
        fn square_root(self) -> Self;
        fn solve<const N: usize>(matrix: &[[Self; N]; N], rhs: &[Self; N]) -> [Self; N];
        fn solve_after<const N: usize>(attempt: &[Self; N], matrix: &[[Self; N]; N], rhs: &[Self; N]) -> [Self; N];
    }
    impl Scalar for f64 {
        fn constant(value: f64) -> f64 { value }
        fn square_root(self) -> f64 { self.sqrt() }
        fn solve<const N: usize>(matrix: &[[f64; N]; N], rhs: &[f64; N]) -> [f64; N] {
            crate::solve::by_elimination(matrix, rhs)
        }
        fn solve_after<const N: usize>(attempt: &[f64; N], matrix: &[[f64; N]; N], rhs: &[f64; N]) -> [f64; N] {
            crate::solve::after(attempt, matrix, rhs)
        }
    }
    impl Scalar for f32 {
        fn constant(value: f64) -> f32 { value as f32 }
        fn square_root(self) -> f32 { self.sqrt() }
        fn solve<const N: usize>(_: &[[f32; N]; N], _: &[f32; N]) -> [f32; N] { unimplemented!() }
        fn solve_after<const N: usize>(_: &[f32; N], _: &[[f32; N]; N], _: &[f32; N]) -> [f32; N] { unimplemented!() }
    }
    pub fn sqrt<T: Scalar>(x: T) -> T { x.square_root() }
    pub fn mul_add<T: Scalar>(a: T, b: T, c: T) -> T { a * b + c }
    pub fn mul_sub<T: Scalar>(a: T, b: T, c: T) -> T { a * b - c }
    pub fn neg_mul_add<T: Scalar>(a: T, b: T, c: T) -> T { c - a * b }
}
mod triple {
    use crate::float::Scalar;
    pub trait Triple: Scalar {
        type Lane: Scalar;
        fn triple(lanes: [Self::Lane; 3]) -> Self;
        fn load(lanes: &[Self::Lane; 4]) -> Self;
        fn splat(number: Self::Lane) -> Self;
        fn lane(self, lane: usize) -> Self::Lane;
        fn mul_add(a: Self::Lane, b: Self::Lane, c: Self::Lane) -> Self::Lane;
        fn mul_sub(a: Self::Lane, b: Self::Lane, c: Self::Lane) -> Self::Lane;
        fn neg_mul_add(a: Self::Lane, b: Self::Lane, c: Self::Lane) -> Self::Lane;
    }
}
/// As on a processor without registers for three numbers.
#[allow(unused_macros)]
macro_rules! single_state {
    ($in_lanes:ident, $flat:ident; $($input:ident: $input_type:ty),*; $($output:ident: $output_type:ty),*) => {
        self::$flat($($input,)* $($output),*);
    };
    (
        $in_lanes:ident, $flat:ident; $($input:ident: $input_type:ty),*;
        only in lanes $($extra:ident: $extra_type:ty),*; $($output:ident: $output_type:ty),*
    ) => {{
        let _ = $(&$extra)*;
        self::$flat($($input,)* $($output),*);
    }};
}
#[allow(unused_imports)]
pub(crate) use single_state;
mod limits {
    pub trait Real: crate::float::Scalar {}
    pub struct Limits<T> {
        pub minimum_length_m: [T; 6],
        pub maximum_length_m: [T; 6],
        pub maximum_velocity_m_s: [T; 6],
        pub maximum_force_n: [T; 6],
        pub maximum_hooke_joint_angle_rad: [T; 6],
        pub maximum_platform_joint_angle_rad: [T; 6],
        pub home_direction_in_base: [[T; 3]; 6],
        pub home_direction_in_platform: [[T; 3]; 6],
        pub minimum_condition_bound: T,
    }
    impl<T: Real> Limits<T> {
        pub fn none() -> Self { unreachable!() }
    }
}
#[allow(unused_imports)]
pub(crate) use limits::{Limits, Real};
mod current {
    pub struct VoiceCoils<T> {
        pub force_constant_n_per_a: [T; 6],
        pub maximum_current_a: [T; 6],
    }
}
mod lanes {
    pub trait Number: crate::float::Scalar + 'static {}
    impl Number for f64 {}
    impl Number for f32 {}
    pub trait Lanes: crate::float::Scalar {
        type Number: Number;
        fn from_fn(number: impl FnMut(usize) -> Self::Number) -> Self;
    }
    pub trait Generic {
        type Parameters<T: crate::float::Scalar>: Copy;
    }
    pub trait InLanes<S: Number>: Generic {
        fn in_lanes<'a, T: Lanes<Number = S>>(of_lane: impl Fn(usize) -> &'a Self) -> Self::Parameters<T>
        where
            Self: 'a;
    }
}
mod solve {
    pub fn solve_general<T: crate::float::Scalar, const N: usize>(matrix: &[[T; N]; N], rhs: &[T; N]) -> [T; N] {
        T::solve(matrix, rhs)
    }
    /// The attempt where it solves the system, else by elimination.
    pub fn solve_after_attempt<T: crate::float::Scalar, const N: usize>(
        attempt: &[T; N],
        matrix: &[[T; N]; N],
        rhs: &[T; N],
    ) -> [T; N] {
        T::solve_after(attempt, matrix, rhs)
    }
    pub fn after<const N: usize>(attempt: &[f64; N], matrix: &[[f64; N]; N], rhs: &[f64; N]) -> [f64; N] {
        let right = matrix.iter().zip(rhs).all(|(row, b)| {
            let terms = row.iter().zip(attempt).map(|(a, x)| a * x);
            let (sum, squares) = terms.fold((0.0, 0.0), |(sum, squares), term| (sum + term, squares + term * term));
            (sum - b) * (sum - b) < 1024.0 * f64::EPSILON * f64::EPSILON * squares
        });
        if right { *attempt } else { by_elimination(matrix, rhs) }
    }
    pub fn solve_after_attempt_in_lanes<P: crate::triple::Triple>(
        _: &[P; 2],
        _: &[[P; 2]; 6],
        _: &[P::Lane; 6],
        _: &[usize; 6],
    ) -> [P::Lane; 6] {
        unreachable!()
    }
    /// Gauss-Jordan with row exchanges; exact for the small integers the tests use.
    pub fn by_elimination<const N: usize>(matrix: &[[f64; N]; N], rhs: &[f64; N]) -> [f64; N] {
        let (mut a, mut x) = (*matrix, *rhs);
        for k in 0..N {
            let pivot = (k..N).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
            a.swap(k, pivot);
            x.swap(k, pivot);
            for i in 0..N {
                if i != k {
                    let f = a[i][k] / a[k][k];
                    for j in 0..N { a[i][j] -= f * a[k][j]; }
                    x[i] -= f * x[k];
                }
            }
        }
        for k in 0..N { x[k] /= a[k][k]; }
        x
    }
}
";

/// Runs every function of `file` through its kernel trait on every case and returns the outputs' elements in order.
/// `cases[k]` holds one flat array per input of `graphs[k]`, parameters included.
pub fn run(
    file: &str,
    graphs: &[Graph],
    cases: &[Vec<Vec<Vec<f64>>>],
    options: &[&str],
) -> Vec<Vec<Vec<f64>>> {
    let signatures: Vec<_> = graphs.iter().map(dyn_gen::emit::Signature::of).collect();
    let header = dyn_gen::emit::Header {
        title: "Traits made for a test.".into(),
        command: "cargo test".into(),
        graphs: vec![dyn_gen::emit::Source { name: "test.json".into(), sha256: "00".into() }],
        platform: None,
        casadi: "0.0.0".into(),
        operations: Vec::new(),
        eliminations: Vec::new(),
        evidence: Vec::new(),
    };
    let kernels = dyn_gen::emit::kernels_file(&header, &signatures).expect("printable traits");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("kernels.rs"), kernels).unwrap();
    std::fs::write(path("model.rs"), file).unwrap();
    let checks = concat!(env!("CARGO_MANIFEST_DIR"), "/../dyn-runtime/src/parameter.rs");
    std::fs::copy(checks, path("parameter.rs")).unwrap();
    let mut main = format!(
        "#![deny(warnings, missing_docs, unused_qualifications)]\n#![allow(dead_code)]\n//! Test.\n\
         /// Traits.\n pub mod kernels;\n/// Parameters.\npub mod parameter;\n/// Model.\npub mod model;\n{RUNTIME}\nfn main() {{\n"
    );
    for (graph, cases) in graphs.iter().zip(cases) {
        for case in cases {
            main.push_str(&call(graph, case));
        }
    }
    main.push_str("}\n");
    std::fs::write(path("main.rs"), main).unwrap();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let compiled = Command::new(rustc)
        .args(["--edition=2024", "main.rs", "-o", "program"])
        .args(options)
        .current_dir(folder.path())
        .output()
        .expect("rustc runs");
    assert!(
        compiled.status.success(),
        "rustc: {}\n{}",
        compiled.status,
        String::from_utf8_lossy(&compiled.stderr)
    );
    let output = Command::new(path("program")).output().expect("the program runs");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let mut lines = text.lines().map(|line| {
        line.split_whitespace().map(|bits| f64::from_bits(u64::from_str_radix(bits, 16).unwrap())).collect()
    });
    cases.iter().map(|cases| lines.by_ref().take(cases.len()).collect()).collect()
}

/// The same by the interpreter.
pub fn interpret(graphs: &[Graph], cases: &[Vec<Vec<Vec<f64>>>]) -> Vec<Vec<Vec<f64>>> {
    let evaluate = |graph: &Graph, case: &Vec<Vec<f64>>| {
        let mut evaluator = Evaluator::new();
        let inputs: Vec<&[f64]> = case.iter().map(Vec::as_slice).collect();
        let values = evaluator.run(graph, &inputs);
        graph.outputs.iter().flat_map(|output| &output.nodes).map(|id| values[id.index()]).collect()
    };
    graphs
        .iter()
        .zip(cases)
        .map(|(graph, cases)| cases.iter().map(|case| evaluate(graph, case)).collect())
        .collect()
}

/// Fails unless all numbers agree bit for bit; any NaN equals any other.
pub fn assert_same_bits(graphs: &[Graph], compiled: &[Vec<Vec<f64>>], interpreted: &[Vec<Vec<f64>>]) {
    for ((graph, compiled), interpreted) in graphs.iter().zip(compiled).zip(interpreted) {
        assert_eq!(compiled.len(), interpreted.len(), "{}", graph.name);
        for (compiled, interpreted) in compiled.iter().zip(interpreted) {
            assert_eq!(compiled.len(), interpreted.len(), "{}", graph.name);
            for (element, (&a, &b)) in compiled.iter().zip(interpreted).enumerate() {
                let same = a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                assert!(same, "{}, element {element}: compiled {a:e}, interpreted {b:e}", graph.name);
            }
        }
    }
}

/// Source that calls one function through its trait and prints the bits of its outputs.
fn call(graph: &Graph, case: &[Vec<f64>]) -> String {
    let mut text = String::from("    {\n");
    let mut arguments = Vec::new();
    let mut parameters = String::new();
    for (symbol, values) in graph.inputs.iter().zip(case) {
        if symbol.parameter {
            let _ = write!(parameters, "{:?} => &{},", symbol.name, flat(values));
            continue;
        }
        let borrow = if symbol.shape.is_empty() { "" } else { "&" };
        let mut elements = values.iter();
        arguments.push(format!("{borrow}std::hint::black_box({})", nested(&symbol.shape, &mut elements)));
    }
    let mut prints = String::new();
    for (index, output) in graph.outputs.iter().enumerate() {
        let zeros = vec![0.0; output.symbol.len()];
        let _ =
            writeln!(text, "        let mut o{index} = {};", nested(&output.symbol.shape, &mut zeros.iter()));
        arguments.push(format!("&mut o{index}"));
        for indices in indices(&output.symbol) {
            let _ = writeln!(prints, "        print!(\"{{:x}} \", o{index}{indices}.to_bits());");
        }
    }
    let model = if parameters.is_empty() {
        "model::TestModel".to_string()
    } else {
        let fill = format!(
            "|name, slots| {{ let values: &[f64] = match name {{ {parameters} _ => return }}; slots.copy_from_slice(values) }}"
        );
        format!("model::TestModel {{ parameters: model::Parameters::from_fn({fill}) }}")
    };
    let kernel = dyn_gen::emit::type_name(&graph.name);
    let _ = writeln!(
        text,
        "        kernels::{kernel}::{}(&{model}, {});\n{prints}        println!();\n    }}",
        graph.name,
        arguments.join(", ")
    );
    text
}

fn number(value: f64) -> String {
    format!("f64::from_bits({:#x})", value.to_bits())
}

fn flat(values: &[f64]) -> String {
    format!("[{}]", values.iter().map(|&value| number(value)).collect::<Vec<_>>().join(", "))
}

fn nested(shape: &[usize], values: &mut std::slice::Iter<f64>) -> String {
    match shape {
        [] => number(*values.next().unwrap()),
        [length, inner @ ..] => {
            format!("[{}]", (0..*length).map(|_| nested(inner, values)).collect::<Vec<_>>().join(", "))
        }
    }
}

fn indices(symbol: &Symbol) -> Vec<String> {
    symbol.shape.iter().fold(vec![String::new()], |prefixes, &length| {
        prefixes
            .iter()
            .flat_map(|prefix| (0..length).map(move |index| format!("{prefix}[{index}]")))
            .collect()
    })
}
