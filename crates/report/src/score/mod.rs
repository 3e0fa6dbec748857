//! Labelled towers, and comparison of predictions with their labels.

mod labelled;
mod oracle_set;
mod summary;

pub use labelled::{Labelled, LabelledError, LineError, MAX_UNPACKED, Truth, parse, read};
pub use oracle_set::OracleSet;
pub use summary::Summary;
