//! Settings of a scene: simulation, physics, environment.

use super::{file, loaded};
use crate::ttt::EngineBlock;
use crate::ttt::chunks::{Dynamics, Environment, ModuleSettings, Simulation};
use crate::ttt::tree::Contents;
use scene::parameters::engine::Engine;
use scene::{Calculations, Scene, Settings};

fn scene(contents: Contents) -> Scene {
    loaded(file(40_100, 22, contents)).0
}

fn simulated(chunk: Simulation) -> Settings {
    scene(Contents {
        simulation: Some(chunk),
        ..Contents::default()
    })
    .settings()
    .clone()
}

#[test]
fn the_step_is_explicit_or_a_preset() {
    let step = |preset, us, old, new| {
        simulated(Simulation {
            old_preset: preset,
            dt_us: us,
            old_dt: old,
            dt: new,
            ..Simulation::default()
        })
        .time_step
    };
    let presets = [0, 1, 2, 3, 4].map(|preset| step(Some(preset), Some(7), Some(0.5), None));
    assert_eq!(presets, [0.2, 0.1, 0.05, 0.025, 0.01]);
    for own in [Some(5), Some(-1), None] {
        assert!((step(own, Some(30_000), Some(0.5), None) - 0.03).abs() < 1e-12);
        assert_eq!(step(own, None, Some(0.5), None), 0.5);
    }
    assert_eq!(step(Some(1), Some(7), Some(0.5), Some(0.25)), 0.25);
    assert_eq!(
        [
            step(None, None, None, None),
            step(None, None, None, Some(f64::NAN))
        ],
        [0.05; 2]
    );
    assert_eq!(
        [
            step(None, None, None, Some(0.0)),
            step(None, None, None, Some(50.0))
        ],
        [0.0001, 10.0]
    );
}

#[test]
fn switches_and_times_of_a_simulation() {
    let flags = |switches| {
        let s = simulated(Simulation {
            switches: Some(switches),
            ..Simulation::default()
        });
        [
            s.real_time,
            s.pause_at_time,
            s.pause_at_error,
            s.remove_new_objects_at_end,
        ]
    };
    assert_eq!(
        [flags(0x1), flags(0x4)],
        [[true, false, false, true], [false, true, false, true]]
    );
    assert_eq!(
        [flags(0x8), flags(0x80)],
        [[false, false, true, true], [false; 4]]
    );
    assert_eq!(flags(0x72), [false, false, false, true]);
    let times = |us, old_pause, pause_time, rt_coef, passes| {
        let settings = simulated(Simulation {
            pause_us: us,
            old_pause,
            pause_time,
            rt_coef,
            old_rt_coef: Some(3.0),
            passes_per_frame: passes,
            ..Simulation::default()
        });
        (
            settings.time_to_pause,
            settings.real_time_factor,
            settings.steps_per_rendering,
        )
    };
    assert_eq!(
        times(Some(2_500_000), Some(7.0), None, None, Some(0)),
        (2.5, 3.0, 1)
    );
    assert_eq!(
        times(Some(2_500_000), Some(7.0), Some(9.0), Some(2.0), Some(4)),
        (9.0, 2.0, 4)
    );
    assert_eq!(times(None, Some(7.0), None, None, None).0, 7.0);
    assert_eq!(
        times(None, None, None, None, None).0,
        Settings::default().time_to_pause
    );
}

fn physics(chunk: Dynamics) -> scene::DynamicsSettings {
    scene(Contents {
        dynamics: Some(chunk),
        ..Contents::default()
    })
    .settings()
    .dynamics
    .clone()
}

#[test]
fn the_physics_of_old_scenes_is_a_preset_unless_it_is_of_its_own() {
    let gravity = [0.0, 0.0, -1.5];
    let block = |step| {
        Some(EngineBlock {
            reals: vec![step],
            ints: Vec::new(),
        })
    };
    let of = |engine, old_engine, oldest_engine, step_size| {
        let settings = physics(Dynamics {
            engine,
            old_engine,
            oldest_engine,
            step_size,
            bullet: block(0.001),
            ode: block(0.002),
            ..Dynamics::default()
        });
        (settings.engine.engine, settings.gravity, settings.step)
    };
    let old = |engine, mode| Some((engine, [0.0, 0.0, -1.5_f32], mode));
    let wide = [0.0, 0.0, -1.5_f32];
    // Old presets are one less: the fifth means settings of its own.
    assert_eq!(
        of(None, old(1, 4), old(0, 0), None),
        (Engine::Ode, wide, 0.002)
    );
    assert_eq!(of(None, old(1, 3), None, None), (Engine::Ode, wide, 0.005));
    assert_eq!(
        of(None, None, old(0, 4), None),
        (Engine::Bullet, wide, 0.001)
    );
    assert_eq!(
        of(Some((1, gravity, 5)), None, None, Some(0.25)),
        (Engine::Ode, wide, 0.25)
    );
    assert_eq!(of(Some((1, gravity, 4)), None, None, None).2, 0.005);
    assert_eq!(
        of(None, None, None, None),
        (Engine::Bullet, [0.0, 0.0, -9.81], 0.001)
    );
    for step in [0.0, -1.0, f64::NAN] {
        assert_eq!(of(None, None, None, Some(step)).2, 0.005, "{step}");
    }
    assert_eq!(
        of(Some((9, [f64::NAN; 3], 5)), None, None, None).1,
        [0.0, 0.0, -9.81]
    );
}

#[test]
fn switches_of_the_physics() {
    let flags = |switches| {
        let settings = physics(Dynamics {
            switches,
            ..Dynamics::default()
        });
        (settings.enabled, settings.show_contact_points)
    };
    assert_eq!(
        [flags(None), flags(Some(0)), flags(Some(1))],
        [(true, false), (false, false), (true, false)]
    );
    assert_eq!(
        [flags(Some(2)), flags(Some(0xfc))],
        [(false, true), (false, false)]
    );
}

fn surroundings(chunk: Environment) -> Settings {
    scene(Contents {
        environment: Some(chunk),
        ..Contents::default()
    })
    .settings()
    .clone()
}

#[test]
fn environments_of_old_scenes() {
    let old = surroundings(Environment {
        old_ambient: Some([0.125, 0.3, 0.0]),
        bg_up: Some([0.5; 3]),
        ..Environment::default()
    });
    assert_eq!(old.environment.ambient_light, [0.25, 0.4, 0.0]);
    assert_eq!(old.environment.background, Some([[0.5; 3]; 2]));
    let new = surroundings(Environment {
        old_ambient: Some([0.125; 3]),
        ambient: Some([0.75; 3]),
        bg_up: Some([0.5; 3]),
        bg_down: Some([0.25; 3]),
        ..Environment::default()
    });
    assert_eq!(new.environment.ambient_light, [0.75; 3]);
    assert_eq!(new.environment.background, Some([[0.5; 3], [0.25; 3]]));
    let flags = |switches| {
        let settings = surroundings(Environment {
            switches: Some(switches),
            ..Environment::default()
        });
        (
            settings.environment.fog.enabled,
            settings.locked,
            settings.environment.display,
        )
    };
    assert_eq!(flags(0x10), (true, false, 0));
    assert_eq!(
        [flags(0x20), flags(0xcf)],
        [(false, true, 0), (false, false, 0xcf)]
    );
}

#[test]
fn calculations_that_are_switched_off() {
    let calculations = |va2, va3, va5| {
        let chunk = ModuleSettings {
            va5,
            va2,
            va3,
            ..ModuleSettings::default()
        };
        scene(Contents {
            module_settings: Some(chunk),
            ..Contents::default()
        })
        .settings()
        .calculations
    };
    let all = Calculations::default();
    assert_eq!(calculations(None, None, None), all);
    assert_eq!(calculations(Some(0x8), Some(0x6), Some(0x1)), all);
    let without = Calculations {
        inverse_kinematics: false,
        ..all
    };
    assert_eq!(calculations(Some(0xf7), None, None), without);
    let without = Calculations {
        collision: false,
        distance: false,
        paths: false,
        ..all
    };
    assert_eq!(calculations(None, Some(0xf9), None), without);
    let without = Calculations {
        proximity_sensors: false,
        ..all
    };
    assert_eq!(calculations(None, None, Some(0xfe)), without);
}
