//! Comparison of counts with a baseline.

use std::fmt::Write;

use crate::baseline::{Baseline, Count};

/// Maximum growth of a count without acceptance. The same program repeats to a few instructions;
/// the rest covers the allocator and memory copies, which the C library selects for the processor.
const MAX_GROWTH: f64 = 0.02;

/// Header of the table.
const HEAD: &str = "instructions                          accepted a frame       a frame    change   a substep  state";

/// Comparison of counts with a baseline.
///
/// ```
/// let comparison = teeter_cost::compare(None, &[], "rustc 1", &[]);
/// assert!(comparison.failures.is_empty());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comparison {
    /// Table for a terminal.
    pub table: String,
    /// Changes to be fixed or accepted, a line each.
    pub failures: Vec<String>,
    /// Notes, a line each.
    pub notes: Vec<String>,
}

/// Compares counts of `compiler` with a baseline. `unavailable` names the workloads in register
/// widths that this processor does not have.
///
/// A different final state is a failure with every compiler, because the bits are the same
/// everywhere. A larger count is a failure only with the compiler of the baseline.
pub fn compare(baseline: Option<&Baseline>, now: &[Count], compiler: &str, unavailable: &[String]) -> Comparison {
    let same_compiler = baseline.is_some_and(|b| b.compiler == compiler);
    let before = baseline.map_or(&[][..], |b| &b.counts);
    let mut result = Comparison { table: HEAD.to_owned() + "\n", failures: Vec::new(), notes: Vec::new() };
    if let Some(baseline) = baseline.filter(|_| !same_compiler) {
        let other = &baseline.compiler;
        result.notes.push(format!("counted with {compiler}, the baseline with {other}: counts are not compared"));
    }
    for count in now {
        let old = before.iter().find(|old| old.name == count.name && old.frames == count.frames);
        result.add_row(old, count);
        match old {
            Some(old) => result.compare_count(old, count, same_compiler),
            None => result.failures.push(format!("{}: is not in the baseline", count.name)),
        }
    }
    for old in before.iter().filter(|old| now.iter().all(|count| count.name != old.name)) {
        match unavailable.contains(&old.name) {
            true => result.notes.push(format!("{}: left out, this processor has no such registers", old.name)),
            false => result.failures.push(format!("{}: is in the baseline but is not counted any more", old.name)),
        }
    }
    result
}

impl Comparison {
    /// Adds the row of a count to the table.
    fn add_row(&mut self, old: Option<&Count>, count: &Count) {
        let per_frame = |c: &Count| grouped(c.instructions / u64::from(c.frames.max(1)));
        let accepted = old.map_or("-".into(), per_frame);
        let change = old.map_or("-".into(), |old| format!("{:+.2} %", 100.0 * growth(old, count)));
        let per_substep = count.instructions.checked_div(u64::from(count.substeps)).map_or("-".into(), grouped);
        let Count { name, hash, .. } = count;
        let now = per_frame(count);
        writeln!(self.table, "{name:36}{accepted:>18}{now:>14}{change:>10}{per_substep:>12}  {hash}")
            .expect("writing to a string does not fail");
    }

    /// Compares a count with the accepted one.
    fn compare_count(&mut self, old: &Count, count: &Count, same_compiler: bool) {
        let (name, growth) = (&count.name, growth(old, count));
        if old.hash != count.hash {
            self.failures.push(format!("{name}: ends in another state than the accepted one, {}", old.hash));
        }
        if same_compiler && growth > MAX_GROWTH {
            self.failures.push(format!("{name}: {:.1} % more instructions", 100.0 * growth));
        }
        if same_compiler && growth < -MAX_GROWTH {
            let fewer = -100.0 * growth;
            self.notes
                .push(format!("{name}: {fewer:.1} % fewer instructions; accept them, or they may come back unseen"));
        }
    }
}

/// Growth of a count over the accepted one, as a fraction.
fn growth(old: &Count, count: &Count) -> f64 {
    count.instructions as f64 / old.instructions as f64 - 1.0
}

/// Formats a number with its digits in groups of three.
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

    fn failures(now: &[Count], compiler: &str, left_out: &[String]) -> Vec<String> {
        compare(Some(&baseline()), now, compiler, left_out).failures
    }

    #[test]
    fn a_count_may_grow_by_two_percent_and_fall_by_any() {
        assert!(failures(&[count("a", 10_199), count("b", 5_000)], "rustc 1", &[]).is_empty());
        let grown = failures(&[count("a", 10_201), count("b", 10_000)], "rustc 1", &[]);
        assert!(grown.len() == 1 && grown[0].starts_with("a: 2.0 % more"), "{grown:?}");
    }

    #[test]
    fn another_compiler_may_change_counts_but_no_state() {
        let now = [count("a", 50_000), count("b", 10_000)];
        let other = compare(Some(&baseline()), &now, "rustc 2", &[]);
        assert!(other.failures.is_empty() && other.notes[0].contains("rustc 2") && other.notes[0].contains("rustc 1"));
        let elsewhere = Count { hash: "fedcba9876543210".into(), ..count("a", 10_000) };
        for compiler in ["rustc 1", "rustc 2"] {
            let failures = failures(&[elsewhere.clone(), count("b", 10_000)], compiler, &[]);
            assert!(failures.len() == 1 && failures[0].contains("0123456789abcdef"), "{failures:?}");
        }
    }

    #[test]
    fn new_and_removed_workloads_need_acceptance() {
        assert!(
            failures(&[count("a", 1), count("b", 1), count("c", 1)], "rustc 1", &[])[0].starts_with("c: is not in")
        );
        assert!(failures(&[count("a", 1)], "rustc 1", &[])[0].starts_with("b: is in"));
        assert!(
            failures(&[count("a", 1)], "rustc 1", &["b".into()]).is_empty(),
            "a workload that the processor cannot play is no failure"
        );
        assert_eq!(compare(None, &[count("a", 1)], "rustc 1", &[]).failures.len(), 1);
        let longer = Count { frames: 20, ..count("a", 20_000) };
        assert!(
            failures(&[longer, count("b", 1)], "rustc 1", &[])[0].starts_with("a: is not in"),
            "a workload of another length is new"
        );
    }

    #[test]
    fn digits_are_grouped_in_threes() {
        assert_eq!([grouped(0), grouped(999), grouped(1000), grouped(1_234_567)], ["0", "999", "1 000", "1 234 567"]);
    }
}
