//! Gradual change of the blocks of a standing tower, so that it stands through the change.
//!
//! The springs of a soft block are strained. Made stiff in one frame they would hold a thousand
//! times the energy, and a tower that had sunk by 20 mm would be thrown to the ceiling. Therefore
//! the stiffness changes by a small factor a frame. Blocks become rigid, or get their first
//! springs, only where springs are so stiff that both forms look the same.

use serde::{Deserialize, Serialize};
use teeter_scene::Form;

/// Factor a frame by which the stiffness changes: three decades in two seconds, in which a soft
/// tower rises without a hop.
const FACTOR: f64 = 1.06;
/// Stiffness from which springs may become rigid, N/m: a tower of 18 rows then moves by a twentieth
/// of a millimetre.
const FIRM: f64 = 1e6;

/// Form of the blocks and stiffness of the springs within them.
///
/// ```
/// use teeter_game::{BlockForm, Simulator};
/// use teeter_physics::{Params, World};
/// use teeter_scene::Form;
///
/// let world = World::new(&teeter_scene::named("block").unwrap(), Params::default())?;
/// let form: BlockForm = world.block_form();
/// assert_eq!(form.form, Form::Rigid);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BlockForm {
    /// Rigid or lattice.
    pub form: Form,
    /// Stiffness of each spring, N/m; of no meaning where the blocks are rigid.
    pub spring_stiffness: f64,
}

/// Sequence of block forms that leads from the present one to the one last asked for.
///
/// ```
/// use teeter_game::{BlockForm, StiffnessRamp};
/// use teeter_scene::Form;
///
/// let rigid = BlockForm { form: Form::Rigid, spring_stiffness: 1e6 };
/// let mut ramp = StiffnessRamp::new(rigid, 1e6);
/// ramp.set_target(BlockForm { form: Form::Lattice, spring_stiffness: 1e4 });
/// assert_eq!(ramp.advance(), Some(BlockForm { form: Form::Lattice, spring_stiffness: 1e6 }));
/// assert!(ramp.advance().unwrap().spring_stiffness < 1e6);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StiffnessRamp {
    current: BlockForm,
    target: BlockForm,
    /// Stiffness at which springs come and go, N/m.
    firm: f64,
}

impl StiffnessRamp {
    /// A ramp at its end. `contact_stiffness` is that of the contacts, N/m.
    pub fn new(current: BlockForm, contact_stiffness: f64) -> Self {
        Self { current, target: current, firm: FIRM.max(contact_stiffness) }
    }

    /// Sets the form that the blocks are to reach.
    pub fn set_target(&mut self, target: BlockForm) {
        self.target = target;
    }

    /// Advances by a frame and returns the form that the blocks take before its step; none where
    /// they stay as they are.
    pub fn advance(&mut self) -> Option<BlockForm> {
        let Self { current, target, firm } = *self;
        self.current = match (current.form, target.form) {
            (Form::Rigid, Form::Rigid) => return None,
            (Form::Rigid, Form::Lattice) => lattice(target.spring_stiffness.max(firm)),
            (Form::Lattice, form) => {
                let goal = match form {
                    Form::Lattice => target.spring_stiffness,
                    Form::Rigid => current.spring_stiffness.max(firm),
                };
                if current.spring_stiffness < goal {
                    lattice(goal.min(current.spring_stiffness * FACTOR))
                } else if current.spring_stiffness > goal {
                    lattice(goal.max(current.spring_stiffness / FACTOR))
                } else if form == Form::Rigid {
                    target
                } else {
                    return None;
                }
            }
        };
        Some(self.current)
    }

    /// Stops the ramp at the form that the blocks have: after a change that was refused.
    pub fn stop_at(&mut self, current: BlockForm) {
        (self.current, self.target) = (current, current);
    }
}

fn lattice(spring_stiffness: f64) -> BlockForm {
    BlockForm { form: Form::Lattice, spring_stiffness }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rigid(spring_stiffness: f64) -> BlockForm {
        BlockForm { form: Form::Rigid, spring_stiffness }
    }

    /// All forms of a ramp, to its end.
    fn forms(ramp: &mut StiffnessRamp) -> Vec<BlockForm> {
        let forms: Vec<BlockForm> = std::iter::from_fn(|| ramp.advance()).take(1000).collect();
        assert!(forms.len() < 1000);
        forms
    }

    fn assert_smooth(forms: &[BlockForm]) {
        for pair in forms.windows(2) {
            let factor = pair[1].spring_stiffness / pair[0].spring_stiffness;
            assert!(factor.max(1.0 / factor) < 1.061, "{pair:?}");
        }
    }

    #[test]
    fn blocks_that_are_as_wanted_stay() {
        assert!(forms(&mut StiffnessRamp::new(rigid(1e6), 1e6)).is_empty());
        assert!(forms(&mut StiffnessRamp::new(lattice(1e3), 1e6)).is_empty());
    }

    #[test]
    fn one_frame_lies_between_rigid_blocks_and_springs_as_stiff_as_the_contacts() {
        let mut ramp = StiffnessRamp::new(rigid(1e6), 1e6);
        ramp.set_target(lattice(1e6));
        assert_eq!(forms(&mut ramp), [lattice(1e6)]);
        ramp.set_target(rigid(1e6));
        assert_eq!(forms(&mut ramp), [rigid(1e6)]);
    }

    #[test]
    fn soft_springs_come_and_go_through_stiff_ones_by_a_small_factor_a_frame() {
        let mut ramp = StiffnessRamp::new(rigid(1e6), 3e5);
        ramp.set_target(lattice(1e3));
        let down = forms(&mut ramp);
        assert_eq!((down[0], *down.last().unwrap()), (lattice(1e6), lattice(1e3)));
        assert_smooth(&down);
        ramp.set_target(rigid(1e3));
        let up = forms(&mut ramp);
        assert_eq!(up[up.len() - 2], lattice(1e6));
        assert_eq!(up[up.len() - 1].form, Form::Rigid);
        assert_smooth(&[&[lattice(1e3)], &up[..up.len() - 1]].concat());
    }

    #[test]
    fn a_target_set_during_a_ramp_is_reached_from_where_the_springs_are() {
        let mut ramp = StiffnessRamp::new(lattice(1e6), 1e6);
        ramp.set_target(lattice(1e3));
        let mut all = vec![ramp.advance().unwrap(), ramp.advance().unwrap()];
        ramp.set_target(lattice(3e6));
        all.extend(forms(&mut ramp));
        assert_smooth(&all);
        assert_eq!(all.last(), Some(&lattice(3e6)));
    }

    #[test]
    fn springs_stiffer_than_the_contacts_need_not_soften_to_become_rigid() {
        let mut ramp = StiffnessRamp::new(lattice(3e7), 1e6);
        ramp.set_target(rigid(3e7));
        assert_eq!(forms(&mut ramp), [rigid(3e7)]);
    }
}
