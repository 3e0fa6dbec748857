//! State of a game as bytes: that of the world, of the hand, and of the detectors.

use serde::{Deserialize, Serialize};
use teeter_physics::envelope::{EnvelopeError, checksum, open, seal};
use teeter_physics::{World, numbers_within};

use crate::blocks::Blocks;
use crate::fall::FallDetector;
use crate::game::Game;
use crate::hand::controller::HandController;
use crate::rest::RestDetector;
use crate::rules::referee::Referee;
use crate::simulator::Simulator;
use crate::stiffness_ramp::{BlockForm, StiffnessRamp};

/// Kind of a snapshot: name and version of its layout.
const KIND: &[u8] = b"teeter-game\x00\x05";

/// Reason why bytes are no snapshot of a game.
///
/// ```
/// use teeter_game::{Game, RestoreError};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut game = Game::new(World::new(&scene, Params::default())?);
/// let bytes = game.snapshot();
/// assert_eq!(game.restore(&bytes), Ok(()));
/// assert_eq!(game.restore(&[]), Err(RestoreError::Magic));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RestoreError {
    /// The bytes do not begin like a snapshot of a game.
    #[error("not a snapshot of this game: it does not begin like one")]
    Magic,
    /// The bytes cannot be read, or hold a state that no game can have.
    #[error("not a snapshot of this game: it is damaged")]
    Damaged,
    /// The world of the snapshot is not that of the game.
    #[error("{0}")]
    World(String),
}

/// All that changes: with the scene, the constants and the commands it determines all of the
/// future.
#[derive(Serialize, Deserialize)]
struct State {
    controller: HandController,
    ramp: StiffnessRamp,
    fall: FallDetector,
    rest: RestDetector,
    referee: Option<Referee>,
    form: BlockForm,
    world: Vec<u8>,
}

impl Game<World> {
    /// State of the game as bytes. They hold neither the scene nor the constants of the run, and
    /// begin with their kind and version, their length and a checksum.
    ///
    /// # Panics
    /// Never: the state is plain numbers, which can always be written.
    pub fn snapshot(&self) -> Vec<u8> {
        let state = State {
            controller: self.controller.clone(),
            ramp: self.ramp.clone(),
            fall: self.fall.clone(),
            rest: self.rest.clone(),
            referee: self.referee.clone(),
            form: self.simulator.block_form(),
            world: self.simulator.snapshot(),
        };
        seal(KIND, &postcard::to_stdvec(&state).expect("plain numbers can always be written"))
    }

    /// Takes over a state of a game of the same scene and constants; it goes on bit for bit as that
    /// one did. The rules come with the state.
    ///
    /// # Errors
    /// When the bytes are no snapshot of this version, or one of another world, or anything in them
    /// has changed; the game is unchanged then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), RestoreError> {
        let content = open(KIND, bytes).map_err(|error| match error {
            EnvelopeError::Kind => RestoreError::Magic,
            EnvelopeError::Damaged => RestoreError::Damaged,
        })?;
        let Ok((state, [])) = postcard::take_from_bytes::<State>(content) else {
            return Err(RestoreError::Damaged);
        };
        let count = self.simulator.len();
        let is_valid = numbers_within(&state, f64::MAX)
            && state.controller.is_of(count)
            && state.fall.is_of(count)
            && state.referee.iter().all(|referee| referee.is_of(count));
        if !is_valid {
            return Err(RestoreError::Damaged);
        }
        let mut world = self.simulator.clone();
        world.set_block_form(state.form).map_err(RestoreError::World)?;
        world.restore(&state.world).map_err(|error| RestoreError::World(error.to_string()))?;
        let State { controller, ramp, fall, rest, referee, .. } = state;
        *self = Self { blocks: Blocks::of(&world), simulator: world, controller, ramp, fall, rest, referee };
        Ok(())
    }

    /// Hash of the whole state: that of the world, the hand, the detectors and the turns. Equal
    /// hashes mean equal futures under equal commands.
    ///
    /// # Panics
    /// Never: the state is plain numbers, which can always be written.
    pub fn state_hash(&self) -> u64 {
        let Self { controller, ramp, fall, rest, referee, .. } = self;
        let rest_of_state = (controller, ramp, fall, rest, referee);
        let mut bytes = postcard::to_stdvec(&rest_of_state).expect("plain numbers can always be written");
        bytes.extend(self.hash().to_le_bytes());
        checksum(&bytes)
    }

    /// Hash of the world's state: equal states have equal hashes on every target.
    pub fn hash(&self) -> u64 {
        self.simulator.hash()
    }
}
