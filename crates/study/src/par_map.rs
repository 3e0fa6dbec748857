//! Map over a slice, in parallel with the feature `parallel`. Results keep the order of the items,
//! so the number of threads changes no bit.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// Returns `f` of each item, in the order of the items. With the feature `parallel` the calls run
/// in the current thread pool of rayon.
///
/// ```
/// assert_eq!(teeter_study::par_map(&[1, 2, 3], |x| x * x), [1, 4, 9]);
/// ```
pub fn par_map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    #[cfg(feature = "parallel")]
    return items.par_iter().map(&f).collect();
    #[cfg(not(feature = "parallel"))]
    return items.iter().map(f).collect();
}
