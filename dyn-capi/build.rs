//! With the feature `own-platform`: bakes the platform file that DYN_PLATFORM names into the library. Without it, nothing.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "own-platform")]
    if let Err(reason) = own_platform::bake() {
        println!("cargo::error={reason}");
        std::process::exit(1);
    }
}

#[cfg(feature = "own-platform")]
mod own_platform {
    use std::env::var_os;
    use std::path::PathBuf;

    use dyn_gen::emit::Scalar;

    /// Writes the model `Baked` and the platform's name where `src/model.rs` includes them.
    pub fn bake() -> Result<(), String> {
        println!("cargo::rerun-if-env-changed=DYN_PLATFORM");
        let path = var_os("DYN_PLATFORM").map(PathBuf::from).ok_or(
            "the feature `own-platform` bakes the platform file that the environment variable DYN_PLATFORM names: set \
             it to an absolute path",
        )?;
        // Says by itself what is wrong with the file, and ends the build.
        dyn_gen::Build::new(&path)
            .model("baked")
            .scalars([Scalar::F64, Scalar::F32])
            .write_to_out_dir("baked.rs");
        let platform = dyn_platform::Platform::from_file(&path).map_err(|error| error.to_string())?;
        let name = PathBuf::from(var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?).join("baked_name.rs");
        std::fs::write(&name, format!("c{:?}", platform.name))
            .map_err(|error| format!("{}: {error}", name.display()))
    }
}
