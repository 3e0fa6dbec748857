//! Strengths of opponents.

use serde::{Deserialize, Serialize};

use crate::analysis::estimate::EstimateErrors;

/// Strength of an opponent.
///
/// ```
/// use teeter_game::Strength;
///
/// assert_eq!(serde_json::from_str::<Strength>(r#""expert""#)?, Strength::Expert);
/// assert!(Strength::Expert.thinking().budget > Strength::Beginner.thinking().budget);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strength {
    /// Takes any block that the rules allow: the baseline.
    Random,
    /// Tries a few blocks in mind, and sees them badly.
    Beginner,
    /// Tries more blocks in mind, and sees them well.
    Skilled,
    /// Tests which blocks are loose, tries the best of them, and of equal ones prefers those that
    /// leave the next player hard ones and a game that counting moves loses.
    Expert,
    /// Lets a child win: takes hard blocks upon itself and leaves the easy ones.
    Gentle,
}

/// Manner in which an opponent thinks.
///
/// ```
/// use teeter_game::Strength;
///
/// assert_eq!(Strength::Random.thinking().candidates, 1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Thinking {
    /// Number of blocks that are tried.
    pub candidates: u32,
    /// True when these are the best by X-ray and limit analysis, and not any.
    pub is_ranked: bool,
    /// Simulated time of all rollouts of a move, s; none are made where it is zero.
    pub budget: f64,
    /// Errors of the estimate.
    pub errors: EstimateErrors,
    /// Chance of a fall that is as bad as leaving the next player a tower with twice the freedom.
    pub trouble: f64,
    /// Chance of its own fall that it wants, rather than none.
    pub risk: f64,
    /// Chance of a fall that is as bad as leaving the next player a game that counting moves wins.
    #[serde(default)]
    pub foresight: f64,
    /// Number of rollouts that the chance of a fall by the X-ray counts as.
    #[serde(default)]
    pub caution: f64,
}

impl Strength {
    /// All strengths.
    pub const ALL: [Self; 5] = [Self::Random, Self::Beginner, Self::Skilled, Self::Expert, Self::Gentle];

    /// Name, as in JSON and in the shell.
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Beginner => "beginner",
            Self::Skilled => "skilled",
            Self::Expert => "expert",
            Self::Gentle => "gentle",
        }
    }

    /// Manner of thinking of this strength.
    pub fn thinking(self) -> Thinking {
        let errors = |height, friction, position| EstimateErrors { height, friction, position };
        let thinking = |candidates, is_ranked, budget, errors| Thinking {
            candidates,
            is_ranked,
            budget,
            errors,
            trouble: 0.0,
            risk: 0.0,
            foresight: 0.0,
            caution: 0.0,
        };
        match self {
            Self::Random => thinking(1, false, 0.0, EstimateErrors::none()),
            Self::Beginner => thinking(4, false, 20.0, errors(1e-4, 0.2, 1e-3)),
            Self::Skilled => thinking(6, false, 50.0, errors(5e-5, 0.1, 5e-4)),
            Self::Expert => {
                let thinking = thinking(8, true, 130.0, errors(2e-5, 0.05, 2e-4));
                Thinking { trouble: 0.02, foresight: 0.1, caution: 4.0, ..thinking }
            }
            Self::Gentle => Thinking { trouble: -0.05, risk: 0.5, ..thinking(4, false, 80.0, errors(5e-5, 0.1, 5e-4)) },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_json() {
        for strength in Strength::ALL {
            assert_eq!(serde_json::to_value(strength).unwrap(), strength.name());
        }
    }
}
