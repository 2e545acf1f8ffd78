//! Generates what the tests compile: some of the test platforms with their numbers baked in, and functions that call any
//! generated function by name, made from the tables of functions so that none can be forgotten.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, error::Error, fs};

use dyn_gen::emit::{RuntimePath, Scalar, type_name};
use dyn_gen::graph::{Program, Symbol};
use dyn_gen::{GraphFile, Numbers, Options, generate};
use dyn_platform::{LegType, Platform};

/// Test platforms that are compiled with baked numbers, besides the default platform of the runtime crate.
const BAKED: [&str; 6] =
    ["tilted_axes", "unequal_legs", "long_thin", "everything", "ups_regular", "ups_everything"];

/// What the default platform may do in `limited`, the model that tests of limits take: all legs, and leg 3.
const LIMITS: &str = "\
[[leg]]
number = 3
maximum_force_n = 80.0
maximum_length_m = 0.215

[legs]
minimum_length_m = 0.18
maximum_force_n = 100.0
force_constant_n_per_a = 40.0
maximum_hooke_joint_angle_rad = 0.3
";

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("platforms");
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let mut models = String::new();
    let mut by_name = String::new();
    let mut baked = vec![(LegType::Uhp, "uhp_2016", "models::Uhp2016".to_owned())];
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
            without: Vec::new(),
        };
        let target = out.join(format!("{name}.rs"));
        let file = GraphFile::of(platform.leg_type)?;
        fs::write(&target, generate(&file, &Numbers::baked(&platform), &options)?.source)?;
        writeln!(models, "#[path = {:?}]\n#[rustfmt::skip]\npub mod {name};", target)?;
        baked.push((platform.leg_type, name, format!("baked::{name}::{}", type_name(name))));
    }
    models += &limited(&folder, &out)?;
    for leg_type in LegType::ALL {
        let program = GraphFile::of(leg_type)?.program;
        by_name += &call(&program)?;
        let at_run_time =
            ["", "Prepared"].map(|form| format!("models::{form}{}", type_name(leg_type.name())));
        let of_type = baked.iter().filter(|(of, ..)| *of == leg_type).map(|(_, _, model)| model);
        for model in of_type.chain(&at_run_time) {
            by_name += &implementation(leg_type, model);
        }
    }
    by_name += &tables(&baked)?;
    fs::write(out.join("models.rs"), models)?;
    fs::write(out.join("by_name.rs"), by_name)?;
    Ok(())
}

/// The default platform with limits; its functions are in the runtime crate.
fn limited(folder: &Path, out: &Path) -> Result<String, Box<dyn Error>> {
    let path = folder.join("../../platforms/uhp_2016.toml");
    println!("cargo::rerun-if-changed={}", path.display());
    let text = fs::read_to_string(&path)?.replacen("[legs]", LIMITS, 1);
    let platform = Platform::from_toml("limited", &text)?;
    let options = Options {
        model: "limited".into(),
        runtime: RuntimePath::new("::dyn_runtime")?,
        scalars: vec![Scalar::F64],
        functions: Some(vec!["rod_alignment".into()]),
        without: Vec::new(),
        command: "cargo test -p dyn-tests".into(),
        evidence: None,
    };
    let target = out.join("limited.rs");
    fs::write(&target, generate(&GraphFile::uhp()?, &Numbers::baked(&platform), &options)?.source)?;
    Ok(format!("#[path = {target:?}]\n#[rustfmt::skip]\npub mod limited;\n"))
}

/// A function that calls the functions of one leg type by name.
fn call(program: &Program) -> Result<String, Box<dyn Error>> {
    let leg_type = &program.name;
    let mut bounds = Vec::new();
    let mut arms = String::new();
    for function in &program.functions {
        let name = &function.name;
        let module = if function.leg_specific { format!("{leg_type}::") } else { String::new() };
        let kernel = format!("dyn_runtime::kernels::{module}{}", type_name(name));
        bounds.push(kernel.clone());
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
        writeln!(arms, "            {kernel}::{name}(model, {arguments});")?;
        for output in &function.outputs {
            writeln!(arms, "            outputs.insert({output:?}.into(), flat(&out_{output}));")?;
        }
        writeln!(arms, "        }}")?;
    }
    Ok(format!(
        "fn call_{leg_type}<M: {}>(model: &M, function: &str, state: &Environment) -> Environment {{\n\
         \x20   let mut outputs = Environment::new();\n    match function {{\n{arms}\
         \x20       _ => panic!(\"there is no function `{{function}}`\"),\n    }}\n    outputs\n}}\n\n",
        bounds.join(" + ")
    ))
}

fn implementation(leg_type: LegType, model: &str) -> String {
    let leg_type = leg_type.name();
    format!(
        "impl Model for {model} {{\n    fn call(&self, function: &str, state: &Environment) -> Environment {{\n\
         \x20       call_{leg_type}(self, function, state)\n    }}\n}}\n\n"
    )
}

/// Names of all functions, which every leg type has, and the models with baked numbers.
fn tables(baked: &[(LegType, &str, String)]) -> Result<String, Box<dyn Error>> {
    let program = GraphFile::uhp()?.program;
    let names: Vec<&str> = program.functions.iter().map(|function| function.name.as_str()).collect();
    let rows: String = baked.iter().map(|(_, name, model)| format!("    ({name:?}, &{model}),\n")).collect();
    Ok(format!(
        "/// Every function of the table.\npub const FUNCTIONS: [&str; {}] = {names:?};\n\n\
         /// Models with baked numbers, by the name of the platform.\n\
         pub const BAKED: [(&str, &dyn Model); {}] = [\n{rows}];\n",
        names.len(),
        baked.len()
    ))
}

fn symbol<'a>(program: &'a Program, name: &str) -> &'a Symbol {
    &program.declaration(name).expect("a checked program declares its symbols").symbol
}

fn array(symbol: &Symbol) -> String {
    symbol.shape.iter().rev().fold("f64".into(), |element, length| format!("[{element}; {length}]"))
}
