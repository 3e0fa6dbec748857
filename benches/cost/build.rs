//! Passes the version of the compiler to the crate, because counts depend on it.

use std::env;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let rustc = env::var("RUSTC").expect("cargo names the compiler");
    let version = Command::new(rustc).arg("-vV").output().expect("the compiler prints its version").stdout;
    let version = String::from_utf8(version).expect("a version is plain text");
    let field =
        |name: &str| version.lines().find_map(|line| line.strip_prefix(name)).map_or("unknown", str::trim).to_owned();
    let target = env::var("TARGET").expect("cargo names the target");
    println!("cargo::rustc-env=COMPILER=rustc {}, LLVM {}, {target}", field("release:"), field("LLVM version:"));
}
