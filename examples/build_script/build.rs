//! Makes the model of `my_platform.toml`, again whenever that file has changed. The payload is left for run time.

fn main() {
    dyn_gen::Build::new("my_platform.toml")
        .runtime(["payload"])
        .functions(["rod_alignment", "actuator_geometry", "inverse_dynamics"])
        .write_to_out_dir("model.rs");
}
