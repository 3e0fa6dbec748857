//! Counted instructions, and holding them against those that were accepted.

use std::fmt::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::Fault;

/// The compiler of this build, as baselines name it.
pub const COMPILER: &str = env!("COMPILER");

/// By how much a count may grow before it has to be accepted. The same program counts the same to a few instructions; the rest leaves room
/// for what is not the engine: the allocator and the copying of memory, which the C library chooses for the processor.
const GROWTH: f64 = 0.02;

/// What the measured frames of a workload cost.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Count {
    /// The workload.
    pub name: String,
    /// Measured frames.
    pub frames: u32,
    /// Substeps in them.
    pub substeps: u32,
    /// Instructions in them.
    pub instructions: u64,
    /// Hash of the state after them.
    pub hash: String,
}

/// The counts that were accepted last.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// Why they are not the ones before.
    pub reason: String,
    /// The compiler and target whose instructions they are.
    pub compiler: String,
    /// In the order of the list of workloads.
    pub counts: Vec<Count>,
}

impl Baseline {
    /// Reads a file.
    ///
    /// # Errors
    /// When there is none, or it is damaged.
    pub fn read(file: &Path) -> Result<Self, Fault> {
        let text = std::fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
        serde_json::from_str(&text).map_err(|e| format!("{}: {e}", file.display()))
    }

    /// Writes a file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, file: &Path) -> Result<(), Fault> {
        let text = serde_json::to_string_pretty(self).expect("texts and numbers can always be written");
        std::fs::write(file, text + "\n").map_err(|e| format!("{}: {e}", file.display()))
    }
}

/// Counts beside a baseline.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comparison {
    /// For reading.
    pub table: String,
    /// What has to be mended or accepted, a line each.
    pub faults: Vec<String>,
    /// What else there is to say, a line each.
    pub notes: Vec<String>,
}

/// Holds counts of this compiler against a baseline. Workloads that this processor cannot play are `left_out`.
///
/// A state that differs is a fault with every compiler: the bits are the same everywhere. A count that has grown is one only with the
/// compiler of the baseline.
pub fn compare(baseline: Option<&Baseline>, now: &[Count], compiler: &str, left_out: &[String]) -> Comparison {
    let (mut faults, mut notes) = (Vec::new(), Vec::new());
    let same_compiler = baseline.is_some_and(|b| b.compiler == compiler);
    let before = baseline.map_or(&[][..], |b| &b.counts);
    if let Some(baseline) = baseline.filter(|_| !same_compiler) {
        notes.push(format!(
            "counted with {compiler}, the baseline with {}: no count is held against it",
            baseline.compiler
        ));
    }
    let mut table = format!(
        "{:36}{:>18}{:>14}{:>10}{:>12}  state\n",
        "instructions", "accepted a frame", "a frame", "change", "a substep"
    );
    for count in now {
        let old = before.iter().find(|old| old.name == count.name && old.frames == count.frames);
        let growth = old.map(|old| count.instructions as f64 / old.instructions as f64 - 1.0);
        let per_frame = |c: &Count| grouped(c.instructions / u64::from(c.frames.max(1)));
        let fields = (old.map_or("-".into(), per_frame), growth.map_or("-".into(), |g| format!("{:+.2} %", 100.0 * g)));
        let per_substep = count.instructions.checked_div(u64::from(count.substeps)).map_or("-".into(), grouped);
        writeln!(
            table,
            "{:36}{:>18}{:>14}{:>10}{per_substep:>12}  {}",
            count.name,
            fields.0,
            per_frame(count),
            fields.1,
            count.hash
        )
        .expect("a string takes all");
        match (old, growth) {
            (Some(old), Some(growth)) => {
                if old.hash != count.hash {
                    faults.push(format!("{}: ends in another state than the accepted one, {}", count.name, old.hash));
                }
                if same_compiler && growth > GROWTH {
                    faults.push(format!("{}: {:.1} % more instructions", count.name, 100.0 * growth));
                }
                if same_compiler && growth < -GROWTH {
                    notes.push(format!(
                        "{}: {:.1} % fewer instructions; accept them, or they may come back unseen",
                        count.name,
                        -100.0 * growth
                    ));
                }
            }
            _ => faults.push(format!("{}: is not in the baseline", count.name)),
        }
    }
    for old in before {
        if now.iter().all(|count| count.name != old.name) {
            match left_out.contains(&old.name) {
                true => notes.push(format!("{}: left out, this processor has no such registers", old.name)),
                false => faults.push(format!("{}: is in the baseline but is not counted any more", old.name)),
            }
        }
    }
    Comparison { table, faults, notes }
}

/// A number with its digits in groups of three.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(' ');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counted;

    fn count(name: &str, instructions: u64) -> Count {
        Count { name: name.into(), frames: 10, substeps: 1000, instructions, hash: "0123456789abcdef".into() }
    }

    fn baseline() -> Baseline {
        Baseline {
            reason: "for a test of the gate".into(),
            compiler: "rustc 1".into(),
            counts: vec![count("a", 10_000), count("b", 10_000)],
        }
    }

    fn faults(now: &[Count], compiler: &str, left_out: &[String]) -> Vec<String> {
        compare(Some(&baseline()), now, compiler, left_out).faults
    }

    #[test]
    fn a_count_may_grow_by_two_percent_and_fall_by_any() {
        assert!(faults(&[count("a", 10_199), count("b", 5_000)], "rustc 1", &[]).is_empty());
        let grown = faults(&[count("a", 10_201), count("b", 10_000)], "rustc 1", &[]);
        assert!(grown.len() == 1 && grown[0].starts_with("a: 2.0 % more"), "{grown:?}");
    }

    #[test]
    fn another_compiler_may_count_anything_but_not_end_in_another_state() {
        let now = [count("a", 50_000), count("b", 10_000)];
        let other = compare(Some(&baseline()), &now, "rustc 2", &[]);
        assert!(other.faults.is_empty() && other.notes[0].contains("rustc 2") && other.notes[0].contains("rustc 1"));
        let elsewhere = Count { hash: "fedcba9876543210".into(), ..count("a", 10_000) };
        for compiler in ["rustc 1", "rustc 2"] {
            let faults = faults(&[elsewhere.clone(), count("b", 10_000)], compiler, &[]);
            assert!(faults.len() == 1 && faults[0].contains("0123456789abcdef"), "{faults:?}");
        }
    }

    #[test]
    fn what_is_new_or_gone_has_to_be_accepted() {
        assert!(faults(&[count("a", 1), count("b", 1), count("c", 1)], "rustc 1", &[])[0].starts_with("c: is not in"));
        assert!(faults(&[count("a", 1)], "rustc 1", &[])[0].starts_with("b: is in"));
        assert!(
            faults(&[count("a", 1)], "rustc 1", &["b".into()]).is_empty(),
            "but for what the processor cannot play"
        );
        assert_eq!(compare(None, &[count("a", 1)], "rustc 1", &[]).faults.len(), 1);
        let longer = Count { frames: 20, ..count("a", 20_000) };
        assert!(
            faults(&[longer, count("b", 1)], "rustc 1", &[])[0].starts_with("a: is not in"),
            "nor is one of another length"
        );
    }

    #[test]
    fn the_committed_baseline_has_every_workload_in_order() {
        let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/baselines/instructions.json"));
        let names: Vec<String> = Baseline::read(file).unwrap().counts.into_iter().map(|count| count.name).collect();
        let listed: Vec<String> = counted().unwrap().into_iter().map(|workload| workload.name).collect();
        assert_eq!(names, listed, "count and accept: tools/counts accept \"why\"");
    }

    #[test]
    fn digits_come_in_threes() {
        assert_eq!([grouped(0), grouped(999), grouped(1000), grouped(1_234_567)], ["0", "999", "1 000", "1 234 567"]);
    }
}
