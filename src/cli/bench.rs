//! `swanilda bench`: how fast a scene is, alone and as many worlds.

use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

use super::interrupt::Interrupt;
use super::run::Kind;
use super::setup::{named_param, step_length};
use super::{Outcome, complain, say};
use script::log::verbosity;
use script::phases::{self, Phases};
use simulator::{Console, LogLine, Options, Simulator};
use vector::{Declaration, Failure, Vector};

/// Exit code when a script raised an error.
const SCRIPT_ERROR: u8 = 1;

/// Measure how fast a scene runs: steps per second, where their time goes, and the same for many worlds
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene: a Lua file, a CoppeliaSim file, or a folder made by unpack
    scene: PathBuf,
    /// Measure each row so long
    #[arg(long, value_name = "SECONDS", default_value_t = 2)]
    seconds: u16,
    /// Worlds that step together [default: 8 for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    worlds: Option<u16>,
    /// Simulation steps after which the simulation begins again, so that both rows are of the same part of it
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Script type to load a Lua file as
    #[arg(long = "as", value_name = "KIND", default_value = "customization")]
    kind: Kind,
    /// Length of a simulation step
    #[arg(long, value_name = "SECONDS", value_parser = step_length, allow_negative_numbers = true)]
    dt: Option<f64>,
    /// Seed for the scripts' random numbers
    #[arg(long)]
    seed: Option<u32>,
    /// Named parameter for scripts (sim.getNamedStringParam); may be repeated
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = named_param)]
    define: Vec<(String, String)>,
}

/// Shows errors of scripts, and nothing else.
struct Errors;

impl Console for Errors {
    fn print(&mut self, _: &[u8], _: f64) {}

    fn log(&mut self, line: &LogLine<'_>) {
        if verbosity::plain(line.level) == verbosity::SCRIPT_ERRORS {
            complain(&line.located());
        }
    }
}

/// Steps that were made, and what they took.
#[derive(Default)]
struct Measured {
    steps: u64,
    time: Duration,
    phases: Phases,
}

impl Measured {
    fn rate(&self) -> f64 {
        self.steps as f64 / self.time.as_secs_f64().max(1e-9)
    }
}

/// Prints the figures.
pub(super) fn bench(args: &Args) -> Outcome {
    let interrupt = Interrupt::of_scripts_here();
    let options = args.options(&interrupt);
    let (step, errors) = args.alone(&options, &interrupt)?;
    if interrupt.is_requested() {
        return Ok(ExitCode::from(interrupt.exit_code()));
    }
    let threads = available_parallelism().map_or(1, NonZero::get);
    let worlds = args.worlds.map_or(8 * threads, usize::from);
    let together = args.together(options, worlds, threads);
    let figures = match &together {
        Ok(together) => {
            let (rate, threads) = (together.rate(), threads.min(worlds));
            let factor = rate * step;
            format!("{threads} threads: {rate:.0} steps/s, {factor:.1} times real time")
        }
        Err(failure) => failure.to_string(),
    };
    say(format!("{worlds} worlds, {figures}\n").as_bytes());
    Ok(if errors > 0 || together.is_err() {
        ExitCode::from(SCRIPT_ERROR)
    } else {
        ExitCode::SUCCESS
    })
}

impl Args {
    fn duration(&self) -> Duration {
        Duration::from_secs(self.seconds.max(1).into())
    }

    fn options(&self, interrupt: &Interrupt) -> Options {
        let defaults = Options::default();
        Options {
            named_params: self.define.iter().cloned().collect(),
            seed: self.seed.unwrap_or(defaults.seed),
            package_dirs: vec![Simulator::folder_of_scene(&self.scene)],
            stop: interrupt.flag(),
            ..defaults
        }
    }

    /// Measures one simulator; the length of its step in seconds, and how many errors scripts had.
    fn alone(&self, options: &Options, interrupt: &Interrupt) -> Result<(f64, u64), String> {
        let mut sim = Simulator::with_console(options.clone(), Box::new(Errors));
        sim.open(&self.scene, self.kind.into())
            .map_err(|error| error.to_string())?;
        if let Some(step) = self.dt {
            sim.scene_mut()
                .modify_settings(|settings| settings.time_step = step);
        }
        let step = sim.scene().settings().time_step;
        let began = now();
        sim.start();
        let start = began.elapsed();
        let measured = run(&mut sim, self.duration(), self.steps, interrupt);
        let spent = measured.phases;
        if measured.steps == 0 {
            return Err("the scene has made no step: a script stops or pauses it".to_owned());
        }
        let of_step = |time: Duration| 1e6 * time.as_secs_f64() / measured.steps as f64;
        let rest = measured.time.saturating_sub(spent.physics + spent.sensors);
        say(format!(
            "{}: {} ms a step; the start takes {:.2} ms\n1 world: {:.0} steps/s, {:.1} times real time\n  physics {:.1} us, sensors {:.1} us, scripts and the rest {:.1} us a step\n",
            self.scene.display(),
            1e3 * step,
            1e3 * start.as_secs_f64(),
            measured.rate(),
            measured.rate() * step,
            of_step(spent.physics),
            of_step(spent.sensors),
            of_step(rest),
        )
        .as_bytes());
        Ok((step, sim.errors()))
    }

    /// Measures many worlds that step together; those whose scripts end the simulation begin again.
    fn together(
        &self,
        options: Options,
        worlds: usize,
        threads: usize,
    ) -> Result<Measured, Failure> {
        // Ctrl-c ends the program.
        let wants_end = Box::new(|| false);
        let mut vector = Vector::new(self.declaration(options), worlds, threads, wants_end)?;
        let all: Vec<(usize, Option<u32>)> = (0..worlds).map(|world| (world, None)).collect();
        fail(vector.begin(&all))?;
        let (began, mut steps) = (now(), 0);
        while began.elapsed() < self.duration() {
            // There are no actions that could be refused.
            fail(vector.step().unwrap_or_default())?;
            let arrays = vector.arrays();
            for world in 0..worlds {
                steps += u64::from(arrays.resets.get(world) == 0);
                let is_over = arrays.terminated.get(world) | arrays.truncated.get(world);
                arrays.resets.set(world, is_over);
            }
        }
        Ok(Measured {
            steps,
            time: began.elapsed(),
            ..Measured::default()
        })
    }

    fn declaration(&self, options: Options) -> Declaration {
        let options = Options {
            render_threads: NonZero::new(1),
            ..options
        };
        Declaration {
            kind: self.kind.into(),
            time_step: self.dt,
            max_steps: self.steps,
            ..Declaration::new(self.scene.clone(), options)
        }
    }
}

fn fail(failures: Vec<Failure>) -> Result<(), Failure> {
    failures.into_iter().next().map_or(Ok(()), Err)
}

/// Steps of one simulator, which starts again after `episode` of them, or where a script ends it; that time does not count.
fn run(sim: &mut Simulator, duration: Duration, episode: u64, interrupt: &Interrupt) -> Measured {
    let mut measured = Measured::default();
    while measured.time < duration && !interrupt.is_requested() {
        let before = measured.steps;
        phases::measure();
        let began = now();
        while measured.steps - before < episode && sim.state().is_advancing() {
            sim.iterate();
            measured.steps += 1;
        }
        measured.time += began.elapsed();
        let spent = phases::measured();
        measured.phases.physics += spent.physics;
        measured.phases.sensors += spent.sensors;
        if measured.steps == before {
            break;
        }
        sim.stop();
        sim.start();
    }
    measured
}

#[allow(
    clippy::disallowed_methods,
    reason = "time is what this command measures"
)]
fn now() -> Instant {
    Instant::now()
}
