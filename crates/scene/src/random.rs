//! Random numbers with the same bits on every target.
//!
//! SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA
//! 2014) is integer arithmetic. Normal deviates by Marsaglia's polar method use a square root,
//! which IEEE 754 defines exactly, and the logarithm of `libm` instead of the platform's.

/// SplitMix64 generator.
///
/// ```
/// use teeter_scene::Random;
///
/// let mut random = Random::new(7);
/// let x = random.uniform();
/// assert!((0.0..1.0).contains(&x));
/// assert_eq!(Random::new(7).uniform(), x);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Random(u64);

impl Random {
    /// Creates the generator of a seed; every seed is equally good, including 0.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = self.0;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a whole number below `n`, or 0 where `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n.max(1) as u64) as usize
    }

    /// Returns a uniform number from 0 to 1, 1 excluded.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a normal deviate with mean 0 and standard deviation 1.
    ///
    /// The second deviate of the method is dropped, so that the state is one integer.
    pub fn normal(&mut self) -> f64 {
        loop {
            let x = 2.0 * self.uniform() - 1.0;
            let y = 2.0 * self.uniform() - 1.0;
            let s = x * x + y * y;
            if s < 1.0 && s > 0.0 {
                return x * (-2.0 * libm::log(s) / s).sqrt();
            }
        }
    }

    /// Returns a normal deviate, redrawn until it is within `limit` standard deviations. `limit`
    /// must be positive.
    pub fn clipped_normal(&mut self, limit: f64) -> f64 {
        loop {
            let x = self.normal();
            if x.abs() <= limit {
                return x;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reference sequence of SplitMix64 for the seed 1234567.
    #[test]
    fn bits_match_the_reference_sequence() {
        let mut r = Random::new(1234567);
        let got: Vec<u64> = (0..5).map(|_| r.bits()).collect();
        assert_eq!(
            got,
            [6457827717110365317, 3203168211198807973, 9817491932198370423, 4593380528125082431, 16408922859458223821]
        );
    }

    /// A logarithm or square root that rounds differently would build another tower from the same
    /// seed.
    #[test]
    fn normal_deviates_have_fixed_bits() {
        let mut r = Random::new(1);
        let got: Vec<u64> = (0..4).map(|_| r.normal().to_bits()).collect();
        assert_eq!(got, [4601407943086469324, 4601894385929139744, 13822931456121442852, 4607432476233908252]);
    }

    #[test]
    fn normal_deviates_have_the_moments_of_a_normal() {
        let mut r = Random::new(7);
        let n = 100_000;
        let x: Vec<f64> = (0..n).map(|_| r.normal()).collect();
        let mean = x.iter().sum::<f64>() / n as f64;
        let var = x.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / n as f64;
        let beyond_two = x.iter().filter(|v| v.abs() > 2.0).count() as f64 / n as f64;
        // Four standard errors each.
        assert!(mean.abs() < 0.0127, "{mean}");
        assert!((var - 1.0).abs() < 0.0179, "{var}");
        assert!((beyond_two - 0.0455).abs() < 0.0027, "{beyond_two}");
    }

    #[test]
    fn clipped_deviates_are_within_the_limit() {
        let mut r = Random::new(3);
        assert!((0..10_000).all(|_| r.clipped_normal(2.0).abs() <= 2.0));
    }
}
