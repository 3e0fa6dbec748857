//! Tells the crate which compiler builds it: another one makes other instructions.

use std::env;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let rustc = env::var("RUSTC").expect("cargo names the compiler");
    let told = Command::new(rustc).arg("-vV").output().expect("the compiler can be asked for its version").stdout;
    let told = String::from_utf8(told).expect("a version is plain text");
    let field =
        |name: &str| told.lines().find_map(|line| line.strip_prefix(name)).map_or("unknown", str::trim).to_owned();
    let target = env::var("TARGET").expect("cargo names the target");
    println!("cargo::rustc-env=COMPILER=rustc {}, LLVM {}, {target}", field("release:"), field("LLVM version:"));
}
