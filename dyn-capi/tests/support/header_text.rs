/// The header of the crate in `folder`, as cbindgen makes it.
fn header_text(folder: &Path) -> Result<String, String> {
    let configuration = cbindgen::Config::from_file(folder.join("cbindgen.toml"))?;
    let bindings =
        cbindgen::generate_with_config(folder, configuration).map_err(|error| error.to_string())?;
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).map_err(|error| error.to_string())
}
