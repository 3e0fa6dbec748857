//! Equal commands give equal bits, also through a snapshot in the middle of a placement.

use crate::common::{block, displace, grasp, settled, tower};
use glam::DVec3;
use teeter_game::{Command, Game, GripMode, TakeAndPlace};
use teeter_scene::Form;

/// The commands of a game in which blocks become soft, a loose one is taken out and placed, and
/// another is poked.
fn record() -> Vec<Command> {
    let mut game = settled(&tower(6, 3));
    let body = block(&game, true);
    let mut commands = vec![Command::SetBlocks { form: Form::Lattice, spring_stiffness: Some(1e5) }];
    commands.extend([Command::Idle; 50]);
    commands.iter().for_each(|command| drop(game.step(command)));
    let mut script = TakeAndPlace::new(body, game.blocks().orientation(body) * DVec3::X, 0.1, None);
    while let Some(command) = script.next(&game) {
        commands.push(command);
        game.step(&command);
        assert!(commands.len() < 1200);
    }
    let other = block(&game, true);
    let last = [grasp(&game, other, GripMode::Auto), Command::Poke];
    commands.extend(last.into_iter().chain([Command::Idle; 30]));
    commands
}

fn play(game: &mut Game, commands: &[Command]) -> Vec<String> {
    commands.iter().map(|c| serde_json::to_string(&game.step(c)).expect("an update can be written")).collect()
}

#[test]
fn the_same_commands_give_the_same_bits_through_text_and_through_snapshots() {
    let commands = record();
    let mut game = settled(&tower(6, 3));
    let updates = play(&mut game, &commands);
    let hash = game.hash();

    let text: Vec<String> =
        commands.iter().map(|c| serde_json::to_string(c).expect("a command can be written")).collect();
    let read: Vec<Command> =
        text.iter().map(|line| serde_json::from_str(line).expect("a command can be read")).collect();
    let mut replay = settled(&tower(6, 3));
    assert_eq!(play(&mut replay, &read), updates);
    assert_eq!(replay.hash(), hash);

    // While springs soften, while the block slides, while it is placed, and while another is poked.
    let is_placing = updates.iter().position(|u| u.contains(r#""placing":true"#)).expect("a block is placed");
    for cut in [10, 70, is_placing + 20, commands.len() - 20] {
        let mut first = settled(&tower(6, 3));
        play(&mut first, &commands[..cut]);
        let bytes = first.snapshot();
        let mut second = settled(&tower(6, 3));
        play(&mut second, &[displace(DVec3::X), Command::Idle]);
        second.restore(&bytes).expect("a snapshot of the same game");
        assert_eq!(second.snapshot(), bytes);
        assert_eq!(play(&mut second, &commands[cut..]), updates[cut..], "from frame {cut}");
        assert_eq!(second.hash(), hash, "from frame {cut}");
    }
}

#[test]
fn bytes_that_are_no_snapshot_leave_the_game_as_it_was() {
    let mut game = settled(&tower(3, 1));
    let bytes = game.snapshot();
    let other = settled(&tower(4, 1)).snapshot();
    for bad in [&[][..], &bytes[..40], &bytes[..bytes.len() - 5], &other, &game.world().snapshot()] {
        let line = game.restore(bad).expect_err("no snapshot of this game").to_string();
        assert!(!line.is_empty() && !line.contains('\n'), "{line}");
        assert_eq!(game.snapshot(), bytes);
    }
}
