//! Accepted counts of instructions.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::error::CostError;

/// Compiler of this build, as baselines name it.
pub const COMPILER: &str = env!("COMPILER");

/// Count of the measured frames of a workload.
///
/// ```
/// use teeter_cost::Count;
///
/// let text = r#"{"name": "a", "frames": 10, "substeps": 980, "instructions": 10000, "hash": "00"}"#;
/// let count: Count = serde_json::from_str(text).expect("five fields");
/// assert_eq!(count.instructions, 10_000);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Count {
    /// Name of the workload.
    pub name: String,
    /// Number of measured frames.
    pub frames: u32,
    /// Number of substeps in them.
    pub substeps: u32,
    /// Number of instructions in them.
    pub instructions: u64,
    /// Hash of the final state.
    pub hash: String,
}

/// Accepted counts.
///
/// ```
/// use std::path::Path;
/// use teeter_cost::Baseline;
///
/// assert!(Baseline::read(Path::new("no such file")).is_err());
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// Reason for the last change of the counts.
    pub reason: String,
    /// Compiler and target of the counts.
    pub compiler: String,
    /// Counts in the order of the list of workloads.
    pub counts: Vec<Count>,
}

impl Baseline {
    /// Reads a file.
    ///
    /// # Errors
    /// When the file is missing or does not parse.
    pub fn read(file: &Path) -> Result<Self, CostError> {
        let text = std::fs::read_to_string(file).map_err(|e| CostError::file(file.display(), e))?;
        serde_json::from_str(&text).map_err(|e| CostError::file(file.display(), e))
    }

    /// Writes a file.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, file: &Path) -> Result<(), CostError> {
        let text = serde_json::to_string_pretty(self).expect("texts and numbers serialise");
        std::fs::write(file, text + "\n").map_err(|e| CostError::file(file.display(), e))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workload::counted;

    #[test]
    fn the_committed_baseline_has_every_workload_in_order() {
        let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/baselines/instructions.json"));
        let names: Vec<String> = Baseline::read(file).unwrap().counts.into_iter().map(|count| count.name).collect();
        let listed: Vec<String> = counted().unwrap().into_iter().map(|workload| workload.name).collect();
        assert_eq!(names, listed, "count and accept: tools/counts accept \"why\"");
    }
}
