//! Golden results, and their replacement.

use std::path::Path;

use serde::{Deserialize, Serialize};
use teeter_physics::Width;
use teeter_physics::envelope::checksum;

use crate::error::GoldenError;
use crate::files::{read, write};
use crate::runs::{Outcome, play_all, runs};

/// Golden result of one run.
///
/// ```
/// use teeter_golden::{Minted, Outcome};
///
/// let outcome = Outcome { step_of_rest: None, hash: "0123456789abcdef".into() };
/// let minted = Minted { name: "rest".into(), outcome };
/// assert_eq!(minted.name, "rest");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Minted {
    /// Name of the run.
    pub name: String,
    /// Outcome of the run.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Golden results.
///
/// ```no_run
/// use std::path::Path;
/// use teeter_golden::Golden;
///
/// let golden = Golden::read(Path::new("data/golden")).expect("minted results");
/// println!("{}", golden.reason);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Golden {
    /// Reason for the last change of the results.
    pub reason: String,
    /// Results in the order of the runs.
    pub runs: Vec<Minted>,
}

const FILE: &str = "hashes.json";

impl Golden {
    /// Reads the results of a folder.
    ///
    /// # Errors
    /// When the file is missing or does not parse.
    pub fn read(dir: &Path) -> Result<Self, GoldenError> {
        serde_json::from_str(&read(dir, FILE)?).map_err(|e| GoldenError::file(FILE, e))
    }

    /// Returns the outcome of a run.
    pub fn outcome(&self, name: &str) -> Option<&Outcome> {
        self.runs.iter().find(|run| run.name == name).map(|run| &run.outcome)
    }

    /// Hash of all results, 16 hexadecimal digits: what names the engine in the records of games.
    pub fn bits(&self) -> String {
        let line = |run: &Minted| format!("{} {:?} {}\n", run.name, run.outcome.step_of_rest, run.outcome.hash);
        format!("{:016x}", checksum(self.runs.iter().map(line).collect::<String>().as_bytes()))
    }
}

/// Minimum number of words of a reason.
const MIN_WORDS: usize = 4;

/// Returns the trimmed reason for a change of committed data.
///
/// # Errors
/// When the text is too short, naming the `subject` that needs a reason.
pub fn reason<'a>(subject: &str, text: &'a str) -> Result<&'a str, GoldenError> {
    let text = text.trim();
    if text.split_whitespace().count() < MIN_WORDS {
        return Err(GoldenError::Reason { subject: subject.to_owned(), words: MIN_WORDS });
    }
    Ok(text)
}

/// Plays all runs, replaces the golden results, and returns the names of the changed runs.
///
/// # Errors
/// When the reason is too short, or two register widths disagree, which is an error of the engine.
pub fn mint(dir: &Path, reason: &str) -> Result<Vec<String>, GoldenError> {
    let reason = self::reason("the bits", reason)?;
    let runs = runs(dir)?;
    let outcomes = play_all(&runs, Width::Auto, 2)?;
    for (run, (first, second)) in runs.iter().zip(outcomes.iter().zip(play_all(&runs, Width::Portable, 2)?)) {
        if *first != second {
            let (first, second) = (first.hash.clone(), second.hash);
            return Err(GoldenError::Disagreement { run: run.name.clone(), first, second });
        }
    }
    let before = Golden::read(dir).ok();
    let minted: Vec<Minted> =
        runs.iter().zip(outcomes).map(|(run, outcome)| Minted { name: run.name.clone(), outcome }).collect();
    if before.as_ref().is_some_and(|before| before.runs == minted) {
        return Ok(Vec::new());
    }
    let changed = minted.iter().filter(|m| before.as_ref().and_then(|b| b.outcome(&m.name)) != Some(&m.outcome));
    let changed = changed.map(|m| m.name.clone()).collect();
    let golden = Golden { reason: reason.to_owned(), runs: minted };
    let text = serde_json::to_string_pretty(&golden).expect("texts and numbers serialise");
    write(dir, FILE, &(text + "\n"))?;
    Ok(changed)
}
