//! A game: a tower, the hand, and one command a frame.

use teeter_physics::{BodyId, ContactReport, World};

use crate::blocks::Blocks;
use crate::command::{Command, Refusal};
use crate::fall::{FallDetector, FrameEnd};
use crate::hand::controller::{Ending, HandController, Touch};
use crate::hand::grip::HoldGrip;
use crate::hand::hold::Task;
use crate::rest::{Motion, RestDetector};
use crate::rules::illegal::Illegal;
use crate::rules::referee::{Frame, Referee};
use crate::rules::table::{Rules, RulesError};
use crate::rules::turn::TurnState;
use crate::simulator::Simulator;
use crate::stiffness_ramp::{BlockForm, StiffnessRamp};
use crate::tower_map::Slot;
use crate::update::{Event, HandState, Update};

/// A tower in play. All of its future follows from the simulator's state and the commands.
///
/// ```
/// use teeter_game::{Command, Game, TowerState};
/// use teeter_physics::{Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let mut game = Game::new(World::new(&scene, Params::default())?);
/// let update = game.step(&Command::Idle);
/// assert_eq!((update.hand, update.tower), (None, TowerState::Standing));
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Game<S: Simulator = World> {
    pub(crate) simulator: S,
    pub(crate) blocks: Blocks,
    pub(crate) controller: HandController,
    pub(crate) ramp: StiffnessRamp,
    pub(crate) fall: FallDetector,
    pub(crate) rest: RestDetector,
    /// None in free play.
    pub(crate) referee: Option<Referee>,
}

impl<S: Simulator> Game<S> {
    /// Free play on a tower that stands as in `simulator`.
    pub fn new(simulator: S) -> Self {
        let blocks = Blocks::of(&simulator);
        Self {
            controller: HandController::new(simulator.hand_can_turn()),
            ramp: StiffnessRamp::new(simulator.block_form(), simulator.contact_stiffness()),
            fall: FallDetector::new(&blocks),
            rest: RestDetector::default(),
            referee: None,
            blocks,
            simulator,
        }
    }

    /// A game by rules, on a tower that stands as in `simulator`. With the rules of free play it is
    /// that of [`Game::new`].
    ///
    /// # Errors
    /// When a rule is out of its range, or no block may be taken.
    pub fn with_rules(simulator: S, rules: Rules) -> Result<Self, RulesError> {
        let mut game = Self::new(simulator);
        rules.validate()?;
        if rules.has_turns() {
            game.referee = Some(Referee::new(rules, &game.blocks)?);
        }
        Ok(game)
    }

    /// The rules.
    pub fn rules(&self) -> Rules {
        self.referee.as_ref().map_or_else(Rules::default, |referee| *referee.rules())
    }

    /// State of the turn; none in free play.
    pub fn turn(&self) -> Option<TurnState> {
        self.referee.as_ref().map(Referee::state)
    }

    /// Judges a command by the rules, as the next step would. In free play all are legal; the hand
    /// may still refuse what it cannot do.
    ///
    /// # Errors
    /// The rule that the command breaks.
    pub fn judge(&self, command: &Command) -> Result<(), Illegal> {
        let held = self.controller.hold().map(|hold| hold.body);
        self.referee.as_ref().map_or(Ok(()), |referee| referee.judge(command, &self.blocks, held))
    }

    /// The simulator.
    pub fn world(&self) -> &S {
        &self.simulator
    }

    /// Geometry of the blocks.
    pub fn blocks(&self) -> &Blocks {
        &self.blocks
    }

    /// Free slots for a block. Of a body that does not exist there are none.
    pub fn slots(&self, body: BodyId) -> Vec<Slot> {
        if self.knows(body) { self.controller.slots_for(&self.blocks, body) } else { Vec::new() }
    }

    /// Returns true if a block can be lifted: nothing is above it.
    pub fn is_free(&self, body: BodyId) -> bool {
        self.knows(body) && crate::headroom::is_free(&self.blocks, body)
    }

    /// Returns true if the command to place this block would be carried out.
    pub fn can_place(&self, body: BodyId) -> bool {
        self.knows(body) && self.controller.can_place(&self.blocks, body)
    }

    /// Grip on a block; none where the hand does not hold it.
    pub fn hold_grip(&self, body: BodyId) -> Option<HoldGrip> {
        self.controller.hold().filter(|hold| hold.body == body).map(|hold| hold.grip)
    }

    /// Returns true while the hand sets a block down by itself.
    pub fn is_placing(&self) -> bool {
        self.controller.hold().is_some_and(|hold| matches!(hold.task, Task::Place { .. }))
    }

    /// Carries out a command and advances by a frame.
    pub fn step(&mut self, command: &Command) -> Update<S::Report> {
        let mut events = Vec::new();
        if let Some(referee) = &mut self.referee {
            referee.begin(&mut events);
        }
        match self.apply(command, &mut events) {
            Ok(()) => {}
            Err(refusal) => events.push(refused(&refusal)),
        }
        self.advance_block_form(&mut events);
        let hand = self.controller.hand(&self.blocks, &self.simulator);
        let outcome = self.simulator.step(hand.as_ref());
        self.blocks.refresh(&self.simulator);
        let held = hand.map(|hand| hand.body);
        let contacts = held.map_or_else(Vec::new, |body| self.simulator.contacts(body));
        let frame = self.simulator.frame();
        if let Some(ending) = self.controller.observe(&self.blocks, outcome.hand_force, &contacts, frame) {
            let body = held.expect("a hold that ends had a hand");
            events.push(match ending {
                Ending::Placed(slot) => Event::Placed { body, slot },
                Ending::Poked => Event::Poked { body },
                Ending::GivenUp => Event::Released { body },
            });
        }
        let held = held.or_else(|| self.simulator.held_by_itself());
        self.observe_tower(outcome.max_speed, held, &mut events);
        self.observe_turn(frame, &mut events);
        let form = self.simulator.block_form();
        Update {
            report: outcome.report,
            hand: self.hand_state(contacts),
            slots: self.controller.slots().to_vec(),
            tower: self.fall.state(),
            fallen: self.fall.fallen(),
            quarantined: self.blocks.bodies().filter(|body| self.simulator.is_quarantined(*body)).collect(),
            at_rest: self.rest.at_rest(),
            form: form.form,
            spring_stiffness: (form.form == teeter_scene::Form::Lattice).then_some(form.spring_stiffness),
            turn: self.turn(),
            events,
        }
    }

    fn knows(&self, body: BodyId) -> bool {
        (body.index()) < self.blocks.len()
    }

    fn apply(&mut self, command: &Command, events: &mut Vec<Event>) -> Result<(), Refusal> {
        self.judge(command)?;
        let mut done = Vec::new();
        self.carry_out(command, &mut done)?;
        let Some(referee) = &mut self.referee else {
            events.append(&mut done);
            return Ok(());
        };
        // A touch can begin the turn that it belongs to.
        let lets_go = referee.accept(command, &self.blocks, events);
        events.append(&mut done);
        if lets_go {
            self.let_go(events);
        }
        Ok(())
    }

    /// Opens the hand where it holds a block.
    fn let_go(&mut self, events: &mut Vec<Event>) {
        if let Ok(body) = self.controller.release() {
            events.push(Event::Released { body });
        }
    }

    fn carry_out(&mut self, command: &Command, events: &mut Vec<Event>) -> Result<(), Refusal> {
        let Self { blocks, controller, simulator, ramp, .. } = self;
        match *command {
            Command::Idle => {}
            Command::Grasp { body, anchor, normal, grip } => {
                controller.grasp(blocks, body, &Touch { anchor, normal }, grip)?;
                events.push(Event::Grasped { body });
            }
            Command::Move { displacement, slot, toward_viewer } => {
                controller.displace(blocks, displacement, slot, toward_viewer)?;
            }
            Command::Turn { rotation } => controller.rotate(rotation)?,
            Command::Place { body, slot } => controller.place(blocks, body, slot)?,
            Command::Poke => events.extend(controller.poke()?.map(|body| Event::Released { body })),
            Command::Release => events.push(Event::Released { body: controller.release()? }),
            Command::SetHand { max_force, careful, can_turn, grip } => {
                let can_turn = can_turn.map(|can_turn| can_turn && simulator.hand_can_turn());
                controller.set(max_force, careful, can_turn, grip)?;
            }
            Command::SetBlocks { form, spring_stiffness } => {
                let spring_stiffness = spring_stiffness.unwrap_or_else(|| simulator.contact_stiffness());
                let form = BlockForm { form, spring_stiffness };
                simulator.check_block_form(form).map_err(Refusal::BlockForm)?;
                ramp.set_target(form);
            }
            Command::Resign if self.referee.is_none() => return Err(Refusal::NoTurns),
            Command::Resign => {}
            Command::Rebuild => {
                self.rebuild()?;
                events.push(Event::Rebuilt);
            }
        }
        Ok(())
    }

    /// Begins again on the tower as it stood at the start.
    fn rebuild(&mut self) -> Result<(), Refusal> {
        self.simulator.restart().map_err(Refusal::Rebuild)?;
        let blocks = Blocks::of(&self.simulator);
        self.controller = HandController::new(self.simulator.hand_can_turn());
        self.ramp = StiffnessRamp::new(self.simulator.block_form(), self.simulator.contact_stiffness());
        (self.fall, self.rest) = (FallDetector::new(&blocks), RestDetector::default());
        if let Some(referee) = &mut self.referee {
            // A tower that gives no block at the start leaves the game over.
            if let Ok(next) = Referee::new(referee.next_game(), &blocks) {
                *referee = next;
            }
        }
        self.blocks = blocks;
        Ok(())
    }

    fn observe_turn(&mut self, seconds: f64, events: &mut Vec<Event>) {
        let Some(referee) = &mut self.referee else { return };
        let fell = events.iter().any(|event| matches!(event, Event::Fell { .. }));
        let held = self.controller.hold().map(|hold| hold.body);
        let frame = Frame { blocks: &self.blocks, held, fell, at_rest: self.rest.at_rest(), seconds };
        if referee.observe(&frame, events) {
            self.let_go(events);
        }
    }

    /// Gives the blocks the next form of the ramp.
    fn advance_block_form(&mut self, events: &mut Vec<Event>) {
        let Some(form) = self.ramp.advance() else { return };
        if let Err(reason) = self.simulator.set_block_form(form) {
            self.ramp.stop_at(self.simulator.block_form());
            events.push(Event::Refused { reason });
        }
    }

    fn observe_tower(&mut self, max_speed: f64, held: Option<BodyId>, events: &mut Vec<Event>) {
        let frame = FrameEnd { time: self.simulator.time(), max_speed, held };
        let bodies = self.fall.observe(&self.blocks, frame);
        if !bodies.is_empty() {
            events.push(Event::Fell { bodies });
        }
        let motion = Motion { max_speed, held: held.is_some(), form: self.simulator.block_form() };
        self.rest.advance(motion, || self.simulator.rest_forces());
    }

    fn hand_state(&self, contacts: Vec<ContactReport>) -> Option<HandState> {
        let hold = self.controller.hold()?;
        Some(HandState {
            body: hold.body,
            grip: hold.grip,
            mode: hold.mode,
            anchor: hold.anchor,
            axes: hold.axes(&self.blocks),
            force: hold.force,
            capped: self.controller.is_capped(hold.force),
            point: hold.point,
            target: hold.limiter.position(),
            goal: hold.goal,
            orientation: hold.orientation,
            placing: matches!(hold.task, Task::Place { .. }),
            poking: matches!(hold.task, Task::Poke { .. }),
            slot: hold.slot,
            stuck_s: hold.stuck_s,
            contacts,
        })
    }
}

/// Event of a command that was refused.
fn refused(refusal: &Refusal) -> Event {
    let reason = refusal.to_string();
    match refusal {
        Refusal::Illegal(rule) => Event::Illegal { rule: *rule, reason },
        _ => Event::Refused { reason },
    }
}
