//! How fast inverse kinematics is, and how often it succeeds:
//!
//!     cargo bench --package swanilda-kinematics
//!
//! First a table over 1000 random reachable poses of a UR5 and a Panda: any posture from a fixed start and from near starts, every answer checked by forward
//! kinematics at 0.1 mm and 1 mrad. Then criterion's times of single calls. `benches/compare/kinematics.py` does the same with other solvers.

#![allow(clippy::disallowed_methods, reason = "a benchmark asks for the time")]

#[path = "../tests/support/mod.rs"]
mod support;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use kinematics::*;
use support::Arm;

const POSES: usize = 1000;
const ACCURACY: [f64; 2] = [1e-4, 1e-3];

fn arms() -> [(&'static str, Arm); 2] {
    [("UR5", Arm::ur5()), ("Panda", Arm::panda())].map(|(name, mut arm)| {
        arm.set_element(|element| element.precision = ACCURACY);
        (name, arm)
    })
}

/// Configs, and their poses.
fn goals(arm: &mut Arm) -> Vec<(Vec<f64>, Pose)> {
    let mut random = Random::new(2024);
    let draw = |_| {
        let config = arm.random_config(&mut random);
        arm.set_config(&config);
        (config, arm.tip_pose())
    };
    (0..POSES).map(draw).collect()
}

struct Times(Vec<Duration>);

impl Times {
    fn row(mut self, what: &str, successes: usize) {
        self.0.sort();
        let mean = self.0.iter().sum::<Duration>() / self.0.len() as u32;
        let at = |share: f64| self.0[((self.0.len() - 1) as f64 * share) as usize];
        println!(
            "| {what} | {:.1} % | {mean:.2?} | {:.2?} | {:.2?} |",
            successes as f64 * 100.0 / POSES as f64,
            at(0.5),
            at(0.99)
        );
    }
}

fn measure(
    arm: &mut Arm,
    what: &str,
    mut prepare: impl FnMut(&mut Arm, usize),
    solve: impl Fn(&mut Arm) -> bool,
) {
    let (mut times, mut successes) = (Times(Vec::new()), 0);
    for i in 0..POSES {
        prepare(arm, i);
        let begin = Instant::now();
        let solved = black_box(solve(arm));
        times.0.push(begin.elapsed());
        let gap = arm.gap();
        successes += usize::from(solved && gap[0] < ACCURACY[0] && gap[1] < ACCURACY[1]);
    }
    times.row(what, successes);
}

fn find(arm: &mut Arm) -> bool {
    arm.env
        .find_posture(arm.group, Start::Present, &mut 100_000)
        .expect("the group exists")
}

fn table(_: &mut Criterion) {
    println!("| task | success | mean | median | 99 % |\n|---|---|---|---|---|");
    for (name, mut arm) in arms() {
        let start = arm.config();
        let goals = goals(&mut arm);
        let mut random = Random::new(5);
        let mut near = |goal: &[f64], by: f64| -> Vec<f64> {
            goal.iter()
                .map(|q| q + by * (2.0 * random.uniform() - 1.0))
                .collect()
        };
        let fixed = |arm: &mut Arm, i: usize| {
            arm.set_config(&start);
            arm.aim(goals[i].1);
        };
        measure(
            &mut arm,
            &format!("{name}: any posture, fixed start"),
            fixed,
            find,
        );
        let close = |arm: &mut Arm, i: usize| {
            arm.set_config(&near(&goals[i].0, 0.2));
            arm.aim(goals[i].1);
        };
        measure(
            &mut arm,
            &format!("{name}: any posture, start within 0.2 rad"),
            close,
            find,
        );
        let mut random = Random::new(6);
        let tracking = |arm: &mut Arm, i: usize| {
            let from: Vec<f64> = goals[i]
                .0
                .iter()
                .map(|q| q + 0.02 * (random.uniform() - 0.5))
                .collect();
            arm.set_config(&from);
            arm.aim(goals[i].1);
        };
        arm.set_group(|group| group.iterations = 10);
        measure(
            &mut arm,
            &format!("{name}: tracking step, pseudo-inverse"),
            tracking,
            |arm| arm.handle().is_success(),
        );
    }
}

fn single_calls(c: &mut Criterion) {
    for (name, mut arm) in arms() {
        let goals = goals(&mut arm);
        let mut i = 0;
        c.bench_function(&format!("{name}/forward kinematics and Jacobian"), |b| {
            b.iter(|| arm.env.equations(arm.group).is_ok());
        });
        c.bench_function(&format!("{name}/any posture"), |b| {
            b.iter(|| {
                i = (i + 1) % POSES;
                arm.aim(goals[i].1);
                find(&mut arm)
            });
        });
        let mut angle = 0.0_f64;
        arm.set_config(if arm.joints.len() == 6 {
            &[0.3, -1.2, 1.4, -1.5, -1.5, 0.1]
        } else {
            &[0.1, -0.4, 0.2, -1.8, 0.3, 1.9, 0.4]
        });
        let centre = arm.tip_pose();
        c.bench_function(&format!("{name}/tracking step"), |b| {
            b.iter(|| {
                angle += 0.01;
                arm.aim(
                    Pose::translation(0.05 * angle.sin(), 0.05 * angle.cos() - 0.05, 0.0) * centre,
                );
                arm.handle()
            });
        });
    }
}

criterion_group!(benches, table, single_calls);
criterion_main!(benches);
