//! The committed header is what cbindgen makes of the sources.

use std::path::Path;

include!("support/header_text.rs");

#[test]
fn the_header_is_fresh() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let committed = std::fs::read_to_string(folder.join("include/dyn_capi.h")).unwrap();
    assert!(
        header_text(folder).unwrap() == committed,
        "include/dyn_capi.h is stale: cargo run -p dyn-capi --example write_header"
    );
}
