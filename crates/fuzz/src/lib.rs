#![doc = include_str!("../README.md")]

mod changes;
mod energy;
mod ini;
mod inputs;
mod record;
mod scene;
mod snapshot;

pub use energy::{Extremes, Range, Violation, random_scene};

use std::path::{Path, PathBuf};

/// Fuzz target: a function that panics where bytes are handled wrongly.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Name, which is that of the folder of its corpus.
    pub name: &'static str,
    /// Runs the target on bytes.
    pub run: fn(&[u8]),
    /// Inputs to begin with that are no files.
    pub seeds: fn() -> Vec<Vec<u8>>,
}

/// All targets.
pub const TARGETS: [Target; 7] = [
    Target { name: "scene", run: scene::run, seeds: scene::seeds },
    Target { name: "ini", run: ini::run, seeds: ini::seeds },
    Target { name: "snapshot", run: snapshot::run, seeds: snapshot::seeds },
    Target { name: "changes", run: changes::run, seeds: changes::seeds },
    Target { name: "inputs", run: inputs::run, seeds: inputs::seeds },
    Target { name: "record", run: record::run, seeds: record::seeds },
    Target { name: "energy", run: energy::run, seeds: energy::seeds },
];

impl Target {
    /// Target of a name.
    ///
    /// # Panics
    /// When there is none.
    pub fn named(name: &str) -> Self {
        let target = TARGETS.into_iter().find(|target| target.name == name);
        target.unwrap_or_else(|| panic!("there is no fuzz target `{name}`"))
    }

    /// Folder of the corpus.
    pub fn folder(&self) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(self.name)
    }

    /// Files of the corpus in the order of their names, then the seeds.
    ///
    /// # Panics
    /// When a file cannot be read.
    pub fn corpus(&self) -> Vec<Vec<u8>> {
        let entries = std::fs::read_dir(self.folder()).expect("the target has a corpus");
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("the folder can be read").path()).collect();
        paths.sort();
        let files = paths.iter().map(|path| std::fs::read(path).expect("the file can be read"));
        files.chain((self.seeds)()).collect()
    }
}
