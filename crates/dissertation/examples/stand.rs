//! A scene by the method of 2003, and what it costs.
use teeter_dissertation::jenga3d::*;
use teeter_scene::*;
#[allow(clippy::disallowed_methods, reason = "measures time")]
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let scene = match args[1].parse::<u32>() {
        Ok(rows) => tower(&TowerOptions { rows, ..TowerOptions::default() }).unwrap(),
        Err(_) => named(&args[1]).unwrap(),
    };
    let secs: f64 = args[2].parse().unwrap();
    let mut c = Constants::default();
    for a in &args[3..] {
        let (k, v) = a.split_once('=').unwrap();
        let f = || v.parse::<f64>().unwrap();
        match k {
            "loops" => c.mid_loop_count = f() as u32,
            "iters" => c.iterations_per_frame = f() as u32,
            "k" => c.stiffness = f(),
            "c" => c.damping = f(),
            "e" => c.restitution = f(),
            "mu" => c.friction = f(),
            "drag" => c.drag = f(),
            "static" => c.static_friction = Some(f()),
            "dis" => {
                c.disabling = match v {
                    "off" => Disabling::Off,
                    "rigid" => Disabling::Rigid,
                    _ => Disabling::Listed,
                }
            }
            "cull" => {
                c.culling = match v {
                    "none" => Culling::None,
                    "blocks" => Culling::Blocks,
                    "boxes" => Culling::Boxes,
                    _ => Culling::Planes,
                }
            }
            "skip" => c.skip_unchanged = f() != 0.0,
            "thr" => c.disable_threshold = f(),
            "order" => {
                c.order = match v {
                    "bottom" => Order::BottomUp,
                    "top" => Order::TopDown,
                    _ => Order::Naive,
                }
            }
            _ => panic!("{k}"),
        }
    }
    let mut s = Jenga3D::new(&scene, c).unwrap();
    let start = s.centres();
    let frames = (secs * 60.0) as u32;
    let clock = std::time::Instant::now();
    let (mut unresolved, mut most) = (0, 0);
    for f in 0..frames {
        let r = s.frame(None);
        unresolved += r.unresolved;
        most = most.max(r.most_sweeps);
        if f % 30 == 29 || f < 3 {
            let d: Vec<f64> = s.centres().iter().zip(&start).map(|(a, b)| 1e3 * a.distance(*b)).collect();
            let h: Vec<f64> = s.centres().iter().zip(&start).map(|(a, b)| 1e3 * (*a - *b).truncate().length()).collect();
            let mx = d.iter().cloned().fold(0.0, f64::max);
            let hx = h.iter().cloned().fold(0.0, f64::max);
            let dis = s.model.blocks.iter().filter(|b| !b.active).count();
            let v = s.curr.iter().map(|p| p.velocity.length()).fold(0.0, f64::max);
            println!(
                "{:.2}s max {:.3} mm aside {:.3} top {:.3} mm dis {} vmax {:.4} contacts {} unres {} sweeps {:.2}/{} E {:.2e} {:?}",
                s.time,
                mx,
                hx,
                1e3 * s.top(),
                dis,
                v,
                s.contacts.len(),
                unresolved,
                r.sweeps as f64 / 1.0 / s.constants.mid_loop_count as f64,
                most,
                s.model.energy(&s.curr),
                r.last.first
            );
        }
    }
    let t = clock.elapsed().as_secs_f64();
    println!("{} blocks: {:.2} ms/frame, {:.1} fps", s.model.blocks.len(), 1e3 * t / frames as f64, frames as f64 / t);
}
