//! A short run of every target on any compiler: the corpus, and a fixed number of changes of it.

use teeter_fuzz::{TARGETS, Target};
use teeter_scene::Random;

/// Changes bytes: one, a run, their number, or a part of others.
fn change(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let at = random.below(bytes.len());
    match random.below(6) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
        1 if !bytes.is_empty() => bytes[at] = random.bits() as u8,
        2 => bytes.truncate(at),
        3 => bytes.insert(at, random.bits() as u8),
        4 => {
            let end = (at + random.below(24)).min(bytes.len());
            bytes.drain(at..end);
        }
        _ => {
            let start = random.below(other.len());
            let end = (start + random.below(64)).min(other.len());
            bytes.splice(at..at, other[start..end].iter().copied());
        }
    }
}

fn run(name: &str, changes: usize) {
    let target = Target::named(name);
    let corpus = target.corpus();
    corpus.iter().for_each(|bytes| (target.run)(bytes));
    let mut random = Random::new(0);
    for _ in 0..changes {
        let mut bytes = corpus[random.below(corpus.len())].clone();
        let other = &corpus[random.below(corpus.len())];
        for _ in 0..=random.below(6) {
            change(&mut bytes, other, &mut random);
        }
        (target.run)(&bytes);
    }
}

#[test]
fn scenes() {
    run("scene", 10_000);
}

#[test]
fn ini_files() {
    run("ini", 10_000);
}

#[test]
fn snapshots() {
    run("snapshot", 200);
}

#[test]
fn changes() {
    run("changes", 5000);
}

#[test]
fn inputs() {
    run("inputs", 40);
}

/// About a million steps: the events of a run are some forty.
#[test]
#[ignore = "takes hours"]
fn a_million_hostile_steps() {
    run("inputs", 25_000);
}

#[test]
fn energies() {
    run("energy", 24);
}

#[test]
fn records() {
    run("record", 2000);
}

#[test]
fn every_target_has_a_corpus() {
    for target in TARGETS {
        assert!(target.folder().is_dir() && !target.corpus().is_empty(), "{}", target.name);
    }
}
