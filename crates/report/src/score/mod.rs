//! Labelled towers, and how predictions compare with their labels.

mod labelled;
mod summary;

pub use labelled::{Labelled, MAX_TOTAL, Truth, parse, read};
pub use summary::{Summary, quantile};
