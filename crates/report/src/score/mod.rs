//! Labelled towers, and comparison of predictions with their labels.

mod labelled;
mod summary;

pub use labelled::{Labelled, LabelledError, LineError, MAX_UNPACKED, Truth, parse, read};
pub use summary::Summary;
