//! Sequential halving: a budget that is spent on ever fewer moves, the worse half of which is
//! dropped after each phase.
//!
//! Z. Karnin, T. Koren, O. Somekh, "Almost optimal exploration in multi-armed bandits", ICML 2013.

/// Moves that are still tried, and the amount to spend before half of them are dropped.
#[derive(Debug, Clone)]
pub struct Halving {
    /// Indices of the moves, in ascending order.
    left: Vec<usize>,
    /// Number of phases that are not over: one for each halving until one move would be left.
    phases: u32,
    budget: f64,
    /// Amount that is spent at the end of the phase.
    until: f64,
}

impl Halving {
    /// Begins with `count` moves. Phases have equal parts of the budget.
    pub fn new(count: usize, budget: f64) -> Self {
        let phases = phases(count);
        Self { left: (0..count).collect(), phases, budget, until: budget / f64::from(phases.max(1)) }
    }

    /// Number of moves, at least two where there are so many, that can be tried once in each phase
    /// until they are dropped, where a try takes `cost` of the budget.
    pub fn affordable(count: usize, budget: f64, cost: f64) -> usize {
        let is_enough = |count: &usize| *count as f64 * f64::from(phases(*count)) * cost <= budget;
        (3..=count).rev().find(is_enough).unwrap_or(count.min(2))
    }

    /// The moves that are still tried.
    pub fn left(&self) -> &[usize] {
        &self.left
    }

    /// Takes in the end of a round, after which `spent` of the budget is spent. Where a phase is
    /// over, the half of the moves with the smaller cost is kept; of equal ones the first.
    pub fn end_round(&mut self, spent: f64, cost: impl Fn(usize) -> f64) {
        if spent < self.until || self.phases <= 1 {
            return;
        }
        self.left.sort_by(|a, b| cost(*a).total_cmp(&cost(*b)).then(a.cmp(b)));
        self.left.truncate(self.left.len().div_ceil(2));
        self.left.sort_unstable();
        self.phases -= 1;
        self.until = spent + (self.budget - spent) / f64::from(self.phases);
    }
}

/// Number of halvings until one move is left.
fn phases(count: usize) -> u32 {
    count.max(1).next_power_of_two().ilog2()
}

#[cfg(test)]
mod tests {
    use teeter_scene::Random;

    use super::*;

    /// Bandit whose arms cost 1 with their probability, each try a unit of the budget. Returns the
    /// arm with the smallest mean, and what was spent.
    fn play(chances: &[f64], budget: f64, seed: u64, is_halved: bool) -> (usize, f64) {
        let mut random = Random::new(seed);
        let mut halving = Halving::new(chances.len(), budget);
        let (mut sums, mut tries, mut spent) = (vec![0.0; chances.len()], vec![0.0; chances.len()], 0.0);
        while spent < budget {
            for &arm in halving.left() {
                sums[arm] += f64::from(u8::from(random.uniform() < chances[arm]));
                tries[arm] += 1.0;
                spent += 1.0;
            }
            if is_halved {
                halving.end_round(spent, |arm| sums[arm] / tries[arm]);
            }
        }
        let mean = |arm: &usize| sums[*arm] / tries[*arm];
        let best = halving.left().iter().copied().min_by(|a, b| mean(a).total_cmp(&mean(b)));
        (best.expect("an arm is left"), spent)
    }

    #[test]
    fn the_budget_is_spent_and_the_last_two_are_compared_to_the_end() {
        for (count, budget) in [(8, 130.0), (5, 50.0), (3, 7.0), (2, 9.0), (1, 4.0), (16, 3.0)] {
            let mut halving = Halving::new(count, budget);
            let (mut spent, mut sizes) = (0.0, vec![count]);
            while spent < budget {
                spent += halving.left().len() as f64;
                halving.end_round(spent, |arm| arm as f64);
                sizes.push(halving.left().len());
            }
            assert!(spent < budget + count as f64, "{spent} of {budget}");
            assert!(sizes.windows(2).all(|pair| pair[1] == pair[0] || pair[1] == pair[0].div_ceil(2)), "{sizes:?}");
            assert!(halving.left().contains(&0) && sizes.last() >= Some(&count.min(2)), "{sizes:?}");
        }
    }

    /// The bound of theorem 4.1: 3 log2 n exp(-T / (8 H log2 n)), with H the largest i / gap_i^2.
    #[test]
    fn the_best_arm_is_missed_no_more_often_than_the_bound_of_the_theorem() {
        let chances = [0.6, 0.55, 0.1, 0.7, 0.6, 0.8, 0.65, 0.9];
        let mut gaps: Vec<f64> = chances.iter().map(|chance| chance - 0.1).collect();
        gaps.sort_by(f64::total_cmp);
        let hardness = (2..=8).map(|i| i as f64 / (gaps[i - 1] * gaps[i - 1])).fold(0.0, f64::max);
        let budget = 8.0 * hardness * 3.0 * libm::log(9.0 / 0.02);
        let missed = (0..500).filter(|seed| play(&chances, budget, *seed, true).0 != 2).count();
        assert!(missed <= 10, "{missed} of 500");
    }

    #[test]
    fn the_better_of_near_arms_is_found_more_often_than_by_rounds_over_all() {
        let chances = [0.5, 0.9, 0.9, 0.3, 0.9, 0.9, 0.9, 0.9];
        let found = |is_halved: bool| (0..600).filter(|seed| play(&chances, 96.0, *seed, is_halved).0 == 3).count();
        let (halved, whole) = (found(true), found(false));
        assert!(halved > whole + 30, "{halved} and {whole} of 600");
    }

    #[test]
    fn no_more_moves_are_begun_than_can_be_tried_in_each_phase() {
        assert_eq!(Halving::affordable(8, 130.0, 4.0), 8);
        // Four moves have two phases.
        assert_eq!(Halving::affordable(8, 32.0, 4.0), 4);
        assert_eq!(Halving::affordable(8, 0.0, 4.0), 2);
        assert_eq!(Halving::affordable(1, 0.0, 4.0), 1);
    }

    #[test]
    fn of_equal_moves_the_first_are_kept() {
        let mut halving = Halving::new(6, 6.0);
        halving.end_round(6.0, |_| 0.5);
        assert_eq!(halving.left(), [0, 1, 2]);
    }
}
