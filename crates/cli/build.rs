//! Rebuilds the program when the page was rebuilt.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var_os("CARGO_FEATURE_PAGE").is_some() {
        // Asked for when it runs: the script may have been built for another checkout.
        let folder = std::env::var("CARGO_MANIFEST_DIR").expect("Cargo sets it");
        let dist = format!("{folder}/../../web/dist");
        println!("cargo::rerun-if-changed={dist}");
        if !std::path::Path::new(&dist).join("index.html").exists() {
            println!("cargo::error=web/dist has no page to put into the program: run `make page` first");
        }
    }
}
