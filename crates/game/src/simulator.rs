//! Simulators that a game can be played on.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, ContactReport, Hand, Input, StepReport, World};
use teeter_scene::{Form, Scene, SceneError, Springs};
use teeter_study::xray;

use crate::stiffness_ramp::BlockForm;

/// Result of a frame.
///
/// ```
/// use teeter_game::Simulator;
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("block").unwrap();
/// let mut world = World::new(&scene, Params::default())?;
/// let outcome = Simulator::step(&mut world, None);
/// assert_eq!(outcome.hand_force, glam::DVec3::ZERO);
/// assert!(outcome.max_speed < 0.1 && outcome.report.awake == 1);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StepOutcome<R> {
    /// Report of the simulator, for the page.
    pub report: R,
    /// Speed of the fastest body, m/s.
    pub max_speed: f64,
    /// Force of the hand on its body, N; zero without a hand.
    pub hand_force: DVec3,
}

/// A tower that is stepped a frame at a time and in which a hand can hold a body.
///
/// ```
/// use teeter_game::Simulator;
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut world = World::new(&scene, Params::default())?;
/// let outcome = Simulator::step(&mut world, None);
/// assert_eq!(outcome.report.time, Simulator::time(&world));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub trait Simulator {
    /// Report on a frame.
    type Report: Serialize;

    /// Number of bodies.
    fn len(&self) -> usize;

    /// True when there is no body.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position (m) and orientation (x, y, z, w) of all bodies, seven numbers each.
    fn poses(&self) -> &[f64];

    /// Edge lengths of a body, m.
    fn size(&self, body: BodyId) -> DVec3;

    /// Simulated time, s.
    fn time(&self) -> f64;

    /// Time that a frame covers, s.
    fn frame(&self) -> f64;

    /// Advances by a frame under a hand.
    fn step(&mut self, hand: Option<&Hand>) -> StepOutcome<Self::Report>;

    /// Loaded contacts of a body.
    fn contacts(&self, body: BodyId) -> Vec<ContactReport>;

    /// Returns true if a body was frozen because its state ran away.
    fn is_quarantined(&self, _body: BodyId) -> bool {
        false
    }

    /// Positions of the eight particles of a body, m; none where it is rigid. Bit k of a particle's
    /// number says on which side of the body's axis k it is.
    fn particles(&self, body: BodyId) -> Option<[DVec3; 8]>;

    /// Distance of the particles from the centre along each axis, over half the edge.
    fn particle_offset(&self) -> f64;

    /// Form of the blocks.
    fn block_form(&self) -> BlockForm;

    /// Stiffness of the contacts, N/m.
    fn contact_stiffness(&self) -> f64;

    /// Checks that blocks could have a form.
    ///
    /// # Errors
    /// The reason, as one line.
    fn check_block_form(&self, form: BlockForm) -> Result<(), String>;

    /// Gives all blocks another form.
    ///
    /// # Errors
    /// The reason, as one line; nothing has changed then.
    fn set_block_form(&mut self, form: BlockForm) -> Result<(), String>;

    /// Goes back to the start, with the blocks in their present form.
    ///
    /// # Errors
    /// The reason, as one line; nothing has changed then. The default refuses.
    fn restart(&mut self) -> Result<(), String> {
        Err("this tower cannot be rebuilt".to_owned())
    }

    /// Body that the simulator holds with a hand of its own, beside that of the game.
    fn held_by_itself(&self) -> Option<BodyId> {
        None
    }

    /// Forces in the contacts by which rest is judged, N. Not a number where a body has none.
    /// `None` for a simulator whose rest is not judged: its tower is never at rest.
    fn rest_forces(&self) -> Option<Vec<f64>> {
        None
    }

    /// Returns true if the hand can rotate a block.
    fn hand_can_turn(&self) -> bool {
        true
    }

    /// Stiffness of the hand, N/m, where its force grows with its lead without a limit; none where
    /// the hand limits its force itself.
    fn hand_stiffness(&self) -> Option<f64> {
        None
    }
}

impl Simulator for World {
    type Report = StepReport;

    fn len(&self) -> usize {
        World::len(self)
    }

    fn poses(&self) -> &[f64] {
        World::poses(self)
    }

    fn size(&self, body: BodyId) -> DVec3 {
        World::size(self, body)
    }

    fn time(&self) -> f64 {
        World::time(self)
    }

    fn frame(&self) -> f64 {
        self.params().frame
    }

    fn step(&mut self, hand: Option<&Hand>) -> StepOutcome<StepReport> {
        let report = World::step(self, &hand.cloned().map_or_else(Input::default, Input::hand));
        let hand_force = report.hand.map_or(DVec3::ZERO, |hand| hand.force);
        StepOutcome { max_speed: report.max_speed, hand_force, report }
    }

    fn contacts(&self, body: BodyId) -> Vec<ContactReport> {
        World::contacts(self, body)
    }

    fn is_quarantined(&self, body: BodyId) -> bool {
        World::is_quarantined(self, body)
    }

    fn particles(&self, body: BodyId) -> Option<[DVec3; 8]> {
        self.lattice(body).map(|report| report.particles)
    }

    fn particle_offset(&self) -> f64 {
        self.scene().springs.particles.inset()
    }

    fn block_form(&self) -> BlockForm {
        BlockForm {
            form: self.form(),
            spring_stiffness: self.spring_stiffness().unwrap_or_else(|| self.scene().spring_stiffness()),
        }
    }

    fn contact_stiffness(&self) -> f64 {
        self.stiffness()
    }

    fn check_block_form(&self, form: BlockForm) -> Result<(), String> {
        // Rigid blocks keep a stiffness too, with which they may become lattices again.
        let lattice = BlockForm { form: Form::Lattice, ..form };
        let scene = Scene { form: Form::Lattice, springs: springs(self, lattice), ..self.scene().clone() };
        scene.validate_constants().map_err(|error: SceneError| error.to_string())
    }

    fn set_block_form(&mut self, form: BlockForm) -> Result<(), String> {
        let springs = springs(self, form);
        self.set_form(form.form, springs).map_err(|error| error.to_string())
    }

    fn restart(&mut self) -> Result<(), String> {
        *self = World::new(self.scene(), *self.params()).map_err(|error| error.to_string())?;
        Ok(())
    }

    fn rest_forces(&self) -> Option<Vec<f64>> {
        let tightness = |load: &teeter_study::Load| if load.below_n > 0.0 { load.tightness_n } else { f64::NAN };
        Some(xray(self, self.scene().friction).iter().flat_map(|load| [load.above_n, tightness(load)]).collect())
    }
}

/// Springs of the scene with the stiffness of `form`. Rigid blocks keep the springs that the scene
/// names.
fn springs(world: &World, form: BlockForm) -> Springs {
    let springs = world.scene().springs;
    match form.form {
        Form::Lattice => Springs { stiffness: Some(form.spring_stiffness), ..springs },
        Form::Rigid => springs,
    }
}
