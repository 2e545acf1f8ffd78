//! Generates what the tests compile: four of the test platforms with their numbers baked in, and a function that calls any
//! generated function by name, made from the table of functions so that none can be forgotten.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, error::Error, fs};

use dyn_gen::emit::{RuntimePath, Scalar, type_name};
use dyn_gen::graph::{Program, Symbol};
use dyn_gen::{GraphFile, Numbers, Options, generate};
use dyn_platform::Platform;

/// Test platforms that are compiled with baked numbers, besides the default platform of the runtime crate.
const BAKED: [&str; 4] = ["tilted_axes", "unequal_legs", "long_thin", "everything"];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("platforms");
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let file = GraphFile::uhp()?;
    let mut models = String::new();
    for name in BAKED {
        let path = folder.join(format!("{name}.toml"));
        println!("cargo::rerun-if-changed={}", path.display());
        let platform = Platform::from_file(&path)?;
        let options = Options {
            model: name.into(),
            runtime: RuntimePath::new("::dyn_runtime")?,
            scalars: vec![Scalar::F64],
            functions: None,
            command: "cargo test -p dyn-tests".into(),
            evidence: None,
        };
        let target = out.join(format!("{name}.rs"));
        fs::write(&target, generate(&file, &Numbers::baked(&platform), &options)?.source)?;
        writeln!(models, "#[path = {:?}]\n#[rustfmt::skip]\npub mod {name};", target)?;
    }
    fs::write(out.join("models.rs"), models)?;
    fs::write(out.join("by_name.rs"), by_name(&file.program)?)?;
    Ok(())
}

/// A trait of all kernels, and a function that calls them by name.
fn by_name(program: &Program) -> Result<String, Box<dyn Error>> {
    let mut bounds = String::new();
    let mut arms = String::new();
    for function in &program.functions {
        let name = &function.name;
        let kernel = type_name(name);
        writeln!(bounds, "    + dyn_runtime::kernels::{kernel}")?;
        writeln!(arms, "        {name:?} => {{")?;
        let mut arguments = String::new();
        for input in &function.inputs {
            let symbol = symbol(program, input);
            writeln!(arms, "            let {input}: {} = array(&state[{input:?}]);", array(symbol))?;
            write!(arguments, "&{input}, ")?;
        }
        for output in &function.outputs {
            let symbol = symbol(program, output);
            writeln!(arms, "            let mut out_{output}: {} = filled();", array(symbol))?;
            write!(arguments, "&mut out_{output}, ")?;
        }
        writeln!(arms, "            dyn_runtime::kernels::{kernel}::{name}(model, {arguments});")?;
        for output in &function.outputs {
            writeln!(arms, "            outputs.insert({output:?}.into(), flat(&out_{output}));")?;
        }
        writeln!(arms, "        }}")?;
    }
    let names: Vec<&str> = program.functions.iter().map(|function| function.name.as_str()).collect();
    Ok(format!(
        "/// Every function of the table.\npub const FUNCTIONS: [&str; {}] = {names:?};\n\n\
         /// A model with every function.\npub trait Model:\n    Sync\n{bounds}{{}}\n\n\
         impl<M: Sync\n{bounds}> Model for M {{}}\n\n\
         /// Outputs of a function of the table by name, flat and row-major.\n\
         pub fn call<M: Model>(model: &M, function: &str, state: &Environment) -> Environment {{\n\
         \x20   let mut outputs = Environment::new();\n    match function {{\n{arms}\
         \x20       _ => panic!(\"there is no function `{{function}}`\"),\n    }}\n    outputs\n}}\n",
        names.len()
    ))
}

fn symbol<'a>(program: &'a Program, name: &str) -> &'a Symbol {
    &program.declaration(name).expect("a checked program declares its symbols").symbol
}

fn array(symbol: &Symbol) -> String {
    symbol.shape.iter().rev().fold("f64".into(), |element, length| format!("[{element}; {length}]"))
}
