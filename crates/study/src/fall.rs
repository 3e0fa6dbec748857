//! Definition of a fall, for a tower that nobody touches and for one in play.

/// Displacement of a block's centre beyond which the block has fallen, m.
///
/// Far above the sag of contacts of 1e6 N/m under a tower that stays as built, and soon exceeded by
/// a block that falls.
pub const FELL_MOVED: f64 = 5e-3;

/// Drop of a block's centre beyond which the block has fallen, m. A block that loses its support
/// drops by a row, 15 mm or more.
pub const FELL_DROPPED: f64 = 3e-3;

/// Returns true if a block of a tower that nobody touches has fallen, by the displacement and the
/// drop of its centre, m.
///
/// A distance that is not finite counts as a fall.
///
/// ```
/// use teeter_study::has_fallen;
///
/// assert!(!has_fallen(4e-3, 1e-3));
/// assert!(has_fallen(6e-3, 0.0) && has_fallen(4e-3, 4e-3) && has_fallen(f64::NAN, 0.0));
/// ```
pub fn has_fallen(displacement: f64, drop: f64) -> bool {
    // a comparison with NaN is false
    !(displacement <= FELL_MOVED && drop <= FELL_DROPPED && drop.is_finite())
}

/// Returns true if a block in play has fallen, by the drop of its centre alone, m: hands and
/// neighbours move blocks sideways.
///
/// ```
/// use teeter_study::has_dropped;
///
/// assert!(!has_dropped(2e-3) && !has_dropped(-0.1));
/// assert!(has_dropped(4e-3) && has_dropped(f64::NAN));
/// ```
pub fn has_dropped(drop: f64) -> bool {
    has_fallen(0.0, drop)
}
