//! Proportion of a number of tries, with its confidence interval.

use serde::Serialize;

/// Normal quantile of a two-sided confidence of 95 %.
const QUANTILE: f64 = 1.959_963_984_540_054;

/// Number of tries, and of those among them that are counted.
///
/// ```
/// use teeter_game::Proportion;
///
/// let falls = Proportion { count: 0, tries: 10 };
/// assert_eq!(falls.share(), 0.0);
/// let [low, high] = falls.interval();
/// assert!(low == 0.0 && (high - 0.2775).abs() < 1e-4);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Proportion {
    /// Number of tries that are counted.
    pub count: u32,
    /// Number of tries.
    pub tries: u32,
}

impl Proportion {
    /// Counts a try.
    pub fn add(&mut self, is_counted: bool) {
        self.tries += 1;
        self.count += u32::from(is_counted);
    }

    /// Share of the tries; a half where there is none.
    pub fn share(&self) -> f64 {
        if self.tries == 0 { 0.5 } else { f64::from(self.count) / f64::from(self.tries) }
    }

    /// Expected probability after these tries where every value was equally likely before
    /// (Laplace): few tries are not certain.
    pub fn expected(&self) -> f64 {
        (f64::from(self.count) + 1.0) / (f64::from(self.tries) + 2.0)
    }

    /// Ends of the interval that contains the probability with a confidence of 95 % (Wilson, J. Am.
    /// Stat. Assoc. 22, 1927, page 209); 0 and 1 where there is no try.
    pub fn interval(&self) -> [f64; 2] {
        if self.tries == 0 {
            return [0.0, 1.0];
        }
        let (n, p, z2) = (f64::from(self.tries), self.share(), QUANTILE * QUANTILE);
        let middle = (p + 0.5 * z2 / n) / (1.0 + z2 / n);
        let half = QUANTILE * (p * (1.0 - p) / n + 0.25 * z2 / (n * n)).sqrt() / (1.0 + z2 / n);
        // The formula is exact at the ends, and rounding is not.
        let low = if self.count == 0 { 0.0 } else { middle - half };
        let high = if self.count == self.tries { 1.0 } else { middle + half };
        [low, high]
    }
}

/// Chance of a fall by rollouts, as analyses write it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FallChance {
    /// Share of the rollouts in which a block fell.
    pub chance_of_fall: f64,
    /// Lower end of the interval of 95 %.
    pub low: f64,
    /// Upper end of the interval of 95 %.
    pub high: f64,
    /// Number of rollouts.
    pub rollouts: u32,
}

impl From<Proportion> for FallChance {
    fn from(falls: Proportion) -> Self {
        let [low, high] = falls.interval();
        Self { chance_of_fall: falls.share(), low, high, rollouts: falls.tries }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval(count: u32, tries: u32) -> [f64; 2] {
        Proportion { count, tries }.interval()
    }

    #[test]
    fn intervals_are_those_of_the_closed_forms() {
        let z2 = QUANTILE * QUANTILE;
        for n in [1, 2, 7, 100] {
            let size = f64::from(n);
            // None counted: from 0 to z^2 / (n + z^2).
            let [low, high] = interval(0, n);
            assert!(low == 0.0 && (high - z2 / (size + z2)).abs() < 1e-12, "{n}");
            // Half of them: a half, give or take z / (2 sqrt(n + z^2)).
            let [low, high] = interval(n, 2 * n);
            let half = QUANTILE / (2.0 * (2.0 * size + z2).sqrt());
            assert!((low - (0.5 - half)).abs() < 1e-12 && (high - (0.5 + half)).abs() < 1e-12, "{n}");
        }
    }

    #[test]
    fn intervals_mirror_and_hold_the_share_and_narrow() {
        for (count, tries) in [(0, 3), (1, 3), (2, 9), (40, 41), (5, 5)] {
            let ([low, high], [mirror_low, mirror_high]) = (interval(count, tries), interval(tries - count, tries));
            let share = Proportion { count, tries }.share();
            assert!(0.0 <= low && low <= share && share <= high && high <= 1.0, "{count} of {tries}");
            assert!((low - (1.0 - mirror_high)).abs() < 1e-12 && (high - (1.0 - mirror_low)).abs() < 1e-12);
            let [narrow_low, narrow_high] = interval(10 * count, 10 * tries);
            assert!(narrow_high - narrow_low < high - low, "{count} of {tries}");
        }
        assert_eq!(interval(0, 0), [0.0, 1.0]);
    }

    #[test]
    fn a_probability_lies_in_its_interval_nineteen_times_of_twenty() {
        let mut random = teeter_scene::Random::new(4);
        for p in [0.1, 0.5, 0.8] {
            let mut held = Proportion::default();
            for _ in 0..2000 {
                let mut tally = Proportion::default();
                (0..60).for_each(|_| tally.add(random.uniform() < p));
                let [low, high] = tally.interval();
                held.add(low <= p && p <= high);
            }
            assert!((held.share() - 0.95).abs() < 0.025, "{p}: {}", held.share());
        }
    }
}
