//! Log of the moves of a game, and of its first fall, for their analysis.

use teeter_physics::{BodyId, World};

use crate::analysis::candidate::Candidate;
use crate::analysis::collapse_cause::{ContactWatch, LostContact};
use crate::game::Game;
use crate::orientation::slide_axis;
use crate::player::stage::MovePlan;
use crate::update::Event;

/// Fall of a recorded tower.
#[derive(Debug, Clone, PartialEq)]
pub struct FallAnalysis {
    /// Time at which the first blocks fell, s.
    pub time_s: f64,
    /// These blocks.
    pub bodies: Vec<BodyId>,
    /// Block that was being taken.
    pub taken: BodyId,
    /// Loaded contact that was lost first; none where none was lost before the fall.
    pub first_lost: Option<LostContact>,
}

/// A move as it was played.
#[derive(Debug, Clone)]
pub struct Played {
    /// Number of the turn, from 1, and player, from 0; zero in free play.
    pub turn: u32,
    /// Player.
    pub player: u32,
    /// Block, and the direction in which it went.
    pub plan: MovePlan,
    /// Time at which it was grasped, s.
    pub time_s: f64,
    /// World before the move.
    pub before: World,
    /// Blocks that could have been taken.
    pub removable: Vec<BodyId>,
    /// True when a block fell in the move.
    pub fell: bool,
}

/// Moves of a game and its first fall, as they are played.
#[derive(Debug, Clone)]
pub struct MoveLog {
    /// Moves in their order.
    pub moves: Vec<Played>,
    /// The first fall.
    pub fall: Option<FallAnalysis>,
    begun: Option<Played>,
    watch: Option<ContactWatch>,
    /// The game before the frame.
    pub before: Game,
}

impl MoveLog {
    /// An empty log of a game that is about to be played.
    pub fn new(start: &Game) -> Self {
        Self { moves: Vec::new(), fall: None, begun: None, watch: None, before: start.clone() }
    }

    /// Takes in the end of a frame.
    pub fn observe(&mut self, game: &Game, events: &[Event]) {
        if let Some(watch) = &mut self.watch {
            watch.observe(game.world());
        }
        for event in events {
            match event {
                Event::Grasped { body } if self.moves.last().is_none_or(|last| !goes_on(last, &self.before, *body)) => {
                    self.begun = Some(begin(&self.before, *body));
                    self.watch = Some(ContactWatch::new(self.before.world(), *body));
                }
                Event::Removed { body, .. } | Event::Placed { body, .. } => {
                    let played = self.begun.take_if(|played| played.plan.body == *body);
                    self.moves.extend(played.map(|played| directed(played, game)));
                }
                Event::Fell { bodies } if self.fall.is_none() => self.observe_fall(game, bodies),
                _ => {}
            }
        }
        self.before.clone_from(game);
    }

    fn observe_fall(&mut self, game: &Game, bodies: &[BodyId]) {
        let Some(watch) = &self.watch else { return };
        self.moves.extend(self.begun.take().map(|played| directed(played, game)));
        self.moves.iter_mut().rev().take(1).for_each(|last| last.fell = true);
        let (time_s, taken) = (game.world().time(), watch.taken());
        self.fall = Some(FallAnalysis { time_s, bodies: bodies.to_vec(), taken, first_lost: watch.first_lost() });
    }
}

/// Returns true if a grasp of `body` goes on with the last move: the block is out already.
fn goes_on(last: &Played, before: &Game, body: BodyId) -> bool {
    let turn = before.turn();
    last.plan.body == body && turn.is_some_and(|turn| turn.number == last.turn && turn.block == Some(body))
}

fn begin(before: &Game, body: BodyId) -> Played {
    let turn = before.turn();
    let removable = turn.as_ref().map_or_else(|| before.blocks().bodies().collect(), |turn| turn.removable.clone());
    let (turn, player) = turn.map_or((0, 0), |turn| (turn.number, turn.player));
    let plan = Candidate::ranked(before.world(), &[body])[0].plan();
    let (time_s, before) = (before.world().time(), before.world().clone());
    Played { turn, player, plan, time_s, before, removable, fell: false }
}

/// The move with the direction in which its block went.
fn directed(played: Played, game: &Game) -> Played {
    let before = played.before.pose(played.plan.body);
    let along = slide_axis(before.orientation);
    let travel = (game.blocks().position(played.plan.body) - before.position).dot(along);
    // What moved less than a millimetre has no direction yet.
    let toward = match travel {
        x if x > 1e-3 => along,
        x if x < -1e-3 => -along,
        _ => played.plan.toward,
    };
    Played { plan: MovePlan { toward, ..played.plan }, ..played }
}
