//! The same measurement on many things, side by side where the feature `parallel` is on. The results come in the order of the things, so how many
//! threads there are changes nothing.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// What `measure` says of each item.
#[cfg(feature = "parallel")]
pub fn each<T: Sync, R: Send>(items: &[T], measure: impl Fn(&T) -> R + Sync) -> Vec<R> {
    items.par_iter().map(&measure).collect()
}

/// What `measure` says of each item.
#[cfg(not(feature = "parallel"))]
pub fn each<T: Sync, R: Send>(items: &[T], measure: impl Fn(&T) -> R + Sync) -> Vec<R> {
    items.iter().map(measure).collect()
}
