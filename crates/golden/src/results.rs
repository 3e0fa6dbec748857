//! What must come of the runs, and how that is changed.

use std::path::Path;

use serde::{Deserialize, Serialize};
use teeter_physics::Width;

use crate::runs::{Outcome, play_all, runs};
use crate::{Fault, read, write};

/// What came of one run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Minted {
    /// Name of the run.
    pub name: String,
    /// What came of it.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// The golden results.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Golden {
    /// Why they are not the ones that they were before.
    pub reason: String,
    /// One a run, in the order of the runs.
    pub runs: Vec<Minted>,
}

const FILE: &str = "hashes.json";

impl Golden {
    /// Those of a folder.
    ///
    /// # Errors
    /// When there are none, or the file is damaged.
    pub fn read(dir: &Path) -> Result<Self, Fault> {
        serde_json::from_str(&read(dir, FILE)?).map_err(|e| format!("{FILE}: {e}"))
    }

    /// The outcome of a run.
    pub fn outcome(&self, name: &str) -> Option<&Outcome> {
        self.runs.iter().find(|run| run.name == name).map(|run| &run.outcome)
    }
}

/// Words that a reason needs: fewer say nothing to who reads it later.
const REASON_WORDS: usize = 4;

/// The reason for which something committed may change, trimmed.
///
/// # Errors
/// When it is too short to be one, naming what it is that may not change without.
pub fn reason<'a>(what: &str, text: &'a str) -> Result<&'a str, Fault> {
    let text = text.trim();
    if text.split_whitespace().count() < REASON_WORDS {
        return Err(format!(
            "{what} may change for a reason only: say in {REASON_WORDS} words or more what changed them"
        ));
    }
    Ok(text)
}

/// Plays all runs and makes what comes of them the golden results; says which changed.
///
/// # Errors
/// When the reason is not one, or when two widths disagree: that is a fault of the engine and nothing to mint.
pub fn mint(dir: &Path, reason: &str) -> Result<Vec<String>, Fault> {
    let reason = self::reason("the bits", reason)?;
    let runs = runs(dir)?;
    let outcomes = play_all(&runs, Width::Auto, 2)?;
    for (run, (one, other)) in runs.iter().zip(outcomes.iter().zip(play_all(&runs, Width::Portable, 2)?)) {
        if *one != other {
            return Err(format!("nothing was minted: two widths disagree on run {}, {one:?} and {other:?}", run.name));
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
    let text = serde_json::to_string_pretty(&golden).expect("texts and numbers can always be written");
    write(dir, FILE, &(text + "\n"))?;
    Ok(changed)
}
