//! Referee: whose turn it is, what a player may do in it, and who loses.
//!
//! A turn goes from choosing over removing and placing to settling. It is judged by the positions
//! of the blocks, so it is all the same whether a block was placed by a command or by hand.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_physics::BodyId;

use crate::blocks::Blocks;
use crate::command::Command;
use crate::headroom::is_free;
use crate::orientation::{angle_between, nearest_alike};
use crate::rules::illegal::Illegal;
use crate::rules::removable::Removal;
use crate::rules::table::{Nudge, Rules, RulesError, Target};
use crate::rules::throw::Throw;
use crate::rules::turn::{Outcome, Phase, TurnState};
use crate::tower_map::{CellId, Slot, TowerMap};
use crate::update::Event;

/// Displacement from which a block was moved, m: touching alone moves it less.
const MOVED: f64 = 0.003;
/// Share of its width by which a block with nothing above it was moved when it is out of the tower.
const OUT: f64 = 0.5;
/// Offset (m), share of the height and angle (rad) within which a block is in a slot.
const IN_SLOT: f64 = 0.012;
const AT_HEIGHT: f64 = 0.25;
const MAX_ASKEW: f64 = 0.2;
/// Blocks of a complete row.
const CELLS: usize = 3;

/// End of a frame, as the referee sees it.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// The blocks.
    pub blocks: &'a Blocks,
    /// Block in the hand.
    pub held: Option<BodyId>,
    /// True when a block fell in the frame.
    pub fell: bool,
    /// True when the tower is at rest.
    pub at_rest: bool,
    /// Time that the frame covers, s.
    pub seconds: f64,
}

/// State of a game's turns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Referee {
    rules: Rules,
    phase: Phase,
    number: u32,
    player: u32,
    /// Time since the turn began without that of settling, and time of settling, s.
    elapsed: f64,
    settling: f64,
    /// Block that was moved, taken out or placed.
    block: Option<BodyId>,
    /// Positions of the blocks that were touched in this turn, when they were touched first, m.
    origins: Vec<(BodyId, DVec3)>,
    /// Blocks that may be taken in this turn.
    removable: Vec<BodyId>,
    throw: Option<Throw>,
    scores: Vec<u32>,
    out: Vec<bool>,
    /// Player who was the last to place a block safely.
    safe: Option<u32>,
    /// Player who placed the last block, and the time for which they answer for a fall that nobody
    /// else's touch causes, s. The turn itself ends earlier where the tower is at rest.
    placer: Option<(u32, f64)>,
    outcome: Option<Outcome>,
    /// True before the first frame.
    is_new: bool,
}

impl Referee {
    /// A game that begins on a tower.
    pub fn new(rules: Rules, blocks: &Blocks) -> Result<Self, RulesError> {
        rules.validate()?;
        let players = rules.players as usize;
        let mut referee = Self {
            rules,
            phase: Phase::Choosing,
            number: 1,
            player: rules.first,
            elapsed: 0.0,
            settling: 0.0,
            block: None,
            origins: Vec::new(),
            removable: Vec::new(),
            throw: None,
            scores: rules.points.map_or_else(Vec::new, |_| vec![0; players]),
            out: vec![false; players],
            safe: None,
            placer: None,
            outcome: None,
            is_new: true,
        };
        referee.survey(blocks);
        if referee.removable.is_empty() { Err(RulesError::NoBlock) } else { Ok(referee) }
    }

    /// The rules.
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// Rules of the game after this one: the player who felled the tower begins.
    pub fn next_game(&self) -> Rules {
        let loser = self.outcome.and_then(|outcome| outcome.loser);
        Rules { first: loser.unwrap_or(self.rules.first), ..self.rules }
    }

    /// State of the turn.
    pub fn state(&self) -> TurnState {
        let touchable = match (self.phase, self.block) {
            (Phase::Over, _) => Vec::new(),
            (Phase::Removing, Some(_)) if self.rules.nudge == Nudge::Ignore => self.removable.clone(),
            (Phase::Removing | Phase::Placing | Phase::Settling, Some(body)) => vec![body],
            _ => self.removable.clone(),
        };
        TurnState {
            number: self.number,
            player: self.player,
            phase: self.phase,
            elapsed_s: self.elapsed,
            left_s: self.rules.turn_s.map(|limit| (limit - self.elapsed).max(0.0)),
            block: self.block,
            removable: touchable,
            throw: self.throw,
            scores: self.scores.clone(),
            out: (0..).zip(&self.out).filter(|(_, out)| **out).map(|(player, _)| player).collect(),
            outcome: self.outcome,
        }
    }

    /// Judges a command by the rules.
    ///
    /// # Errors
    /// The rule that it breaks.
    pub fn judge(&self, command: &Command, blocks: &Blocks, held: Option<BodyId>) -> Result<(), Illegal> {
        match *command {
            Command::Idle => Ok(()),
            Command::Rebuild if self.phase == Phase::Over => Ok(()),
            Command::Rebuild => Err(Illegal::NotOver),
            Command::Release => Ok(()),
            _ if self.phase == Phase::Over => Err(Illegal::Over),
            Command::Grasp { body, .. } => self.may_touch(body, blocks),
            Command::Place { body, .. } => {
                body.map_or(Ok(()), |body| self.may_touch(body, blocks))?;
                let body = body.or(held).filter(|body| body.index() < blocks.len());
                let is_out = self.phase == Phase::Placing || body.is_none_or(|body| is_free(blocks, body));
                if is_out { Ok(()) } else { Err(Illegal::NotTakenOut) }
            }
            Command::SetHand { max_force: Some(force), .. } if force > self.rules.max_force => {
                Err(Illegal::TooStrong { max_force: self.rules.max_force })
            }
            Command::SetBlocks { .. } if self.phase != Phase::Choosing || held.is_some() => Err(Illegal::BlockForm),
            _ => Ok(()),
        }
    }

    fn may_touch(&self, body: BodyId, blocks: &Blocks) -> Result<(), Illegal> {
        if body.index() >= blocks.len() {
            // The hand refuses it by its number.
            return Ok(());
        }
        match (self.phase, self.block) {
            (Phase::Removing | Phase::Placing | Phase::Settling, Some(block)) if block == body => Ok(()),
            (Phase::Removing, Some(body)) if self.rules.nudge == Nudge::PutBack => Err(Illegal::PutBackFirst { body }),
            (Phase::Removing, Some(body)) if self.rules.nudge == Nudge::Take => Err(Illegal::MustTake { body }),
            (Phase::Placing, Some(body)) => Err(Illegal::OneBlock { body }),
            // The touch is that of the next player.
            (Phase::Settling, _) => self.removal(blocks, self.number + 1).judge(body),
            _ if self.removable.contains(&body) => Ok(()),
            _ => self.removal(blocks, self.number).judge(body).and(Err(Illegal::NotInTower { body })),
        }
    }

    /// Takes in a command that was carried out. Returns true if the hand has to let go.
    pub fn accept(&mut self, command: &Command, blocks: &Blocks, events: &mut Vec<Event>) -> bool {
        match *command {
            Command::Grasp { body, .. } | Command::Place { body: Some(body), .. } => {
                self.touch(body, blocks, events);
                false
            }
            Command::Resign => {
                events.push(Event::Resigned { player: self.player });
                self.eliminate(blocks, events);
                true
            }
            _ => false,
        }
    }

    fn touch(&mut self, body: BodyId, blocks: &Blocks, events: &mut Vec<Event>) {
        match self.phase {
            Phase::Settling if self.block == Some(body) => self.phase = Phase::Placing,
            Phase::Settling => self.end_turn(blocks, events),
            Phase::Removing if self.block != Some(body) => (self.phase, self.block) = (Phase::Choosing, None),
            _ => {}
        }
        self.placer = None;
        let before = self.origins.iter().position(|(other, _)| *other == body);
        let origin = before.map_or((body, blocks.position(body)), |index| self.origins.remove(index));
        self.origins.push(origin);
    }

    /// Reports the first turn.
    pub fn begin(&mut self, events: &mut Vec<Event>) {
        if std::mem::take(&mut self.is_new) {
            self.announce(events);
        }
    }

    /// Takes in the end of a frame. Returns true if the hand has to let go.
    pub fn observe(&mut self, frame: &Frame, events: &mut Vec<Event>) -> bool {
        if self.phase == Phase::Over {
            return false;
        }
        if frame.fell {
            self.finish(self.placer.map_or(self.player, |(player, _)| player), events);
            return false;
        }
        self.placer = self.placer.and_then(|(player, left)| {
            let left = left - frame.seconds;
            (left > 0.5 * frame.seconds).then_some((player, left))
        });
        match self.phase {
            Phase::Settling => self.settling += frame.seconds,
            _ => self.elapsed += frame.seconds,
        }
        match self.phase {
            Phase::Choosing | Phase::Removing => self.observe_removal(frame, events),
            Phase::Placing if frame.held.is_none() => self.observe_placing(frame.blocks, events),
            Phase::Settling => self.observe_settling(frame, events),
            _ => {}
        }
        let is_late = self.rules.turn_s.is_some_and(|limit| self.elapsed >= limit - 0.5 * frame.seconds);
        if is_late && !matches!(self.phase, Phase::Settling | Phase::Over) {
            events.push(Event::TimedOut { player: self.player });
            self.eliminate(frame.blocks, events);
            return true;
        }
        false
    }

    fn observe_removal(&mut self, frame: &Frame, events: &mut Vec<Event>) {
        let blocks = frame.blocks;
        let Some(body) = frame.held.or(self.block).or(self.last_touched()) else { return };
        let Some((_, origin)) = self.origins.iter().find(|(other, _)| *other == body) else { return };
        let displacement = blocks.position(body).distance(*origin);
        if displacement > OUT * blocks.size(body).y && is_free(blocks, body) {
            (self.phase, self.block) = (Phase::Placing, Some(body));
            events.push(Event::Removed { player: self.player, body });
        } else if displacement > MOVED {
            if self.block != Some(body) {
                events.push(Event::Nudged { player: self.player, body });
            }
            (self.phase, self.block) = (Phase::Removing, Some(body));
        } else if self.block == Some(body) && frame.held.is_none() {
            (self.phase, self.block) = (Phase::Choosing, None);
            events.push(Event::PutBack { player: self.player, body });
        }
    }

    /// The block that was touched last: it may still move after it was poked.
    fn last_touched(&self) -> Option<BodyId> {
        self.origins.last().map(|(body, _)| *body)
    }

    fn observe_placing(&mut self, blocks: &Blocks, events: &mut Vec<Event>) {
        let Some(body) = self.block else { return };
        let slot = self.slot_of(blocks, body);
        if slot.is_none() && self.rules.target == Target::OnTop {
            return;
        }
        (self.phase, self.settling) = (Phase::Settling, 0.0);
        let is_reported = events.iter().any(|event| matches!(event, Event::Placed { body: b, .. } if *b == body));
        if let Some(slot) = slot.filter(|_| !is_reported) {
            events.push(Event::Placed { body, slot });
        }
    }

    fn observe_settling(&mut self, frame: &Frame, events: &mut Vec<Event>) {
        let slid = |body| self.rules.target == Target::OnTop && self.slot_of(frame.blocks, body).is_none();
        if self.block.is_none_or(slid) {
            self.phase = Phase::Placing;
        } else if frame.at_rest || self.settling >= self.rules.settle_s - 0.5 * frame.seconds {
            self.end_turn(frame.blocks, events);
        }
    }

    /// Slot on top of the tower that a block stands in.
    fn slot_of(&self, blocks: &Blocks, body: BodyId) -> Option<CellId> {
        let (position, orientation, size) = (blocks.position(body), blocks.orientation(body), blocks.size(body));
        let is_in = |slot: &Slot| {
            let offset = position - slot.position;
            offset.truncate().length() < IN_SLOT
                && offset.z.abs() < AT_HEIGHT * size.z
                && angle_between(nearest_alike(slot.orientation, orientation), orientation) < MAX_ASKEW
        };
        let slots = TowerMap::new(blocks, Some(body)).slots(size);
        if slots.is_empty() {
            // The top row has a gap that no block fits in: it may be forced in, or put above.
            let cells = TowerMap::new(blocks, None).cells();
            let highest = cells.iter().map(|(_, cell)| cell.row).max();
            let cell = cells.iter().find(|(other, _)| *other == body).map(|(_, cell)| *cell);
            return cell.filter(|cell| Some(cell.row) == highest);
        }
        slots.iter().find(|slot| is_in(slot)).map(Slot::id)
    }

    /// Ends a turn in which a block was placed safely.
    fn end_turn(&mut self, blocks: &Blocks, events: &mut Vec<Event>) {
        events.push(Event::Settled { player: self.player });
        self.safe = Some(self.player);
        let left = self.rules.settle_s - self.settling;
        self.placer = (left > 0.0).then_some((self.player, left));
        if let (Some(points), Some(body)) = (self.rules.points, self.block) {
            let cells = TowerMap::new(blocks, None).cells();
            let row = cells.iter().find(|(other, _)| *other == body).map(|(_, cell)| cell.row);
            let in_row = cells.iter().filter(|(_, cell)| Some(cell.row) == row).count();
            let points = points.block + if in_row == CELLS { points.row } else { 0 };
            let score = &mut self.scores[self.player as usize];
            *score = score.saturating_add(points);
            events.push(Event::Scored { player: self.player, points });
        }
        self.begin_turn(blocks, events);
    }

    fn begin_turn(&mut self, blocks: &Blocks, events: &mut Vec<Event>) {
        self.player = self.player_after(self.player);
        self.number = self.number.saturating_add(1);
        (self.phase, self.elapsed, self.settling) = (Phase::Choosing, 0.0, 0.0);
        self.block = None;
        self.origins.clear();
        self.survey(blocks);
        self.announce(events);
        if self.removable.is_empty() {
            self.finish(self.player, events);
        }
    }

    fn announce(&self, events: &mut Vec<Event>) {
        events.push(Event::TurnStarted { player: self.player, number: self.number });
        events.extend(self.throw.map(|throw| Event::Thrown { throw }));
    }

    /// Takes the player whose turn it is out of the game.
    fn eliminate(&mut self, blocks: &Blocks, events: &mut Vec<Event>) {
        self.out[self.player as usize] = true;
        let left = self.out.iter().filter(|out| !**out).count();
        if left > 1 {
            self.begin_turn(blocks, events);
        } else {
            self.finish(self.player, events);
        }
    }

    fn finish(&mut self, loser: u32, events: &mut Vec<Event>) {
        let is_in = |player: &u32| *player != loser && !self.out[*player as usize];
        let before = (1..self.rules.players).map(|k| (loser + self.rules.players - k) % self.rules.players);
        let winner = self.safe.filter(is_in).or_else(|| before.into_iter().find(is_in));
        self.phase = Phase::Over;
        self.outcome = Some(Outcome { loser: Some(loser), winner });
        events.push(Event::Lost { player: loser });
        events.extend(winner.map(|player| Event::Won { player }));
    }

    /// The next player who is in the game.
    fn player_after(&self, player: u32) -> u32 {
        let players = self.rules.players;
        (1..=players).map(|k| (player + k) % players).find(|next| !self.out[*next as usize]).unwrap_or(player)
    }

    /// Finds the blocks that may be taken in this turn.
    fn survey(&mut self, blocks: &Blocks) {
        self.throw = self.throw_of(self.number);
        self.removable = self.removal(blocks, self.number).blocks(blocks);
    }

    fn removal(&self, blocks: &Blocks, number: u32) -> Removal {
        Removal::new(blocks, self.rules.source, self.throw_of(number))
    }

    fn throw_of(&self, number: u32) -> Option<Throw> {
        self.rules.die.map(|seed| Throw::of(seed, number))
    }

    /// Returns true if the state is one of a game with `count` bodies.
    pub fn is_of(&self, count: usize) -> bool {
        let players = self.rules.players;
        let is_body = |body: &BodyId| body.index() < count;
        let is_player = |player: &u32| *player < players;
        let has_block = matches!(self.phase, Phase::Removing | Phase::Placing | Phase::Settling);
        self.rules.validate().is_ok()
            && self.rules.has_turns()
            && is_player(&self.player)
            && self.safe.iter().all(is_player)
            && self.placer.iter().all(|(player, _)| is_player(player))
            && self.out.len() == players as usize
            && self.scores.len() == self.rules.points.map_or(0, |_| players as usize)
            && self.block.iter().chain(&self.removable).chain(self.origins.iter().map(|(body, _)| body)).all(is_body)
            && (self.phase == Phase::Over || self.block.is_some() == has_block)
            && self.outcome.is_some() == (self.phase == Phase::Over)
            && self.outcome.iter().flat_map(|o| o.loser.iter().chain(&o.winner)).all(is_player)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blocks::samples::{moved, tower};
    use crate::hand::grip::GripMode;
    use crate::rules::table::Table;

    #[test]
    fn a_gap_that_no_block_fits_in_does_not_end_the_game_without_a_loser() {
        // Body 8 lies across the unfinished row of the bodies 6 and 7.
        let above = tower(&["xxx", "xxx", "x.x", ".x."], 0.0);
        let referee = Referee::new(Rules::of(Table::Official, 2), &above).unwrap();
        assert_eq!(referee.slot_of(&above, BodyId(8)), None, "the row beneath is completed first");
        let narrow = moved(&above, 6, DVec3::Y * 0.002);
        assert_eq!(referee.slot_of(&narrow, BodyId(8)), Some(CellId { row: 3, cell: 1 }));
        let beside = moved(&narrow, 8, DVec3::new(0.3, 0.0, -3.0 * 0.018));
        assert_eq!(referee.slot_of(&beside, BodyId(8)), None);
    }

    /// Loser of a game in which player 0 places a block, the tower rests after a second, and a
    /// block falls some seconds after placing; with a touch of player 1 before it, or without.
    fn loser(fall_s: u32, is_touched: bool) -> Option<u32> {
        let before = tower(&["xxx", "xxx", "xxx"], 0.0);
        let (body, other) = (BodyId(4), BodyId(1));
        let mut referee = Referee::new(Rules::of(Table::Official, 2), &before).unwrap();
        let grasp = |body| Command::Grasp { body, anchor: DVec3::ZERO, normal: DVec3::X, grip: GripMode::Auto };
        let mut events = Vec::new();
        let mut observe = |referee: &mut Referee, blocks: &Blocks, held, fell, at_rest| {
            referee.observe(&Frame { blocks, held, fell, at_rest, seconds: 1.0 / 60.0 }, &mut events);
        };
        referee.accept(&grasp(body), &before, &mut Vec::new());
        let out = moved(&before, body.0, DVec3::new(0.2, 0.0, 0.0));
        observe(&mut referee, &out, Some(body), false, false);
        let slot = TowerMap::new(&out, Some(body)).slots(out.size(body))[1].position;
        let placed = moved(&before, body.0, slot - before.position(body));
        observe(&mut referee, &placed, None, false, false);
        assert_eq!(referee.phase, Phase::Settling);
        for frame in 1..=60 * fall_s {
            if is_touched && frame == 60 * fall_s {
                referee.accept(&grasp(other), &placed, &mut Vec::new());
            }
            observe(&mut referee, &placed, None, false, frame >= 60);
        }
        assert_eq!((referee.player, referee.phase), (1, Phase::Choosing));
        observe(&mut referee, &placed, None, true, false);
        referee.outcome.unwrap().loser
    }

    #[test]
    fn a_tower_that_falls_untouched_within_ten_seconds_is_that_of_the_player_who_placed() {
        assert_eq!(loser(3, false), Some(0));
        assert_eq!(loser(9, false), Some(0));
        assert_eq!(loser(11, false), Some(1), "the turn before is over");
        assert_eq!(loser(3, true), Some(1), "a touch begins the next turn");
    }
}
