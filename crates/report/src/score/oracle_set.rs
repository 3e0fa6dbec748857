//! Towers with known answers that are a part of the program.

use super::labelled::{Labelled, LabelledError, read};

/// File of `data/oracle`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OracleSet {
    /// 400 towers that stand or fall.
    Config,
    /// 50 towers with the angle of the floor at which they collapse.
    Tilt,
}

impl OracleSet {
    /// Reads all towers of the set.
    ///
    /// # Errors
    /// When the program was built with a file that is not of labelled towers.
    pub fn towers(self) -> Result<Vec<Labelled>, LabelledError> {
        let packed: &[u8] = match self {
            Self::Config => include_bytes!("../../../../data/oracle/config.jsonl.gz"),
            Self::Tilt => include_bytes!("../../../../data/oracle/tilt.jsonl.gz"),
        };
        read(packed, "a file of the program")
    }
}
