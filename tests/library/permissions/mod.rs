//! What scripts may do to the world outside: every way there is refused where it is not allowed, and open where it is.

mod routes;

use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};

use routes::{ADDRESSES, CERTIFICATES, NATIVE, READS, RUNS, Route, WRITES};
use swanilda::{Options, Permissions, ScriptKind, Simulator};
use tempfile::TempDir;
use test_support::parallel;

use crate::lines::Lines;

/// Files and folders: `in` is what a test allows, `out` is beside it and holds the same.
struct World {
    folder: TempDir,
}

impl World {
    fn new() -> Self {
        let world = Self {
            folder: tempfile::tempdir().expect("a temporary folder can be made"),
        };
        for name in ["in", "out"] {
            world.fill(&world.path(name));
        }
        #[cfg(unix)]
        std::os::unix::fs::symlink(world.path("out"), world.path("in/link"))
            .expect("links can be made");
        world
    }

    fn fill(&self, folder: &Path) {
        fs::create_dir_all(folder.join("sub")).expect("our own folder is writable");
        fs::write(folder.join("secret.lua"), "return 'the secret'")
            .expect("our own folder is writable");
        fs::write(folder.join("victim"), "alive").expect("our own folder is writable");
        fs::create_dir(folder.join("empty")).expect("our own folder is writable");
        fs::write(
            folder.join("mesh.obj"),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        )
        .expect("our own folder is writable");
        for (name, file) in [
            ("scene.ttt", "world.ttt"),
            ("model.ttm", "part.ttm"),
            ("scene.xml", "kinds.simscene.xml"),
        ] {
            let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
            fs::copy(data.join(file), folder.join(name)).expect("our own data are there");
        }
        let code =
            "sim = require 'sim' sim.saveImage(('a'):rep(12), {2, 2}, 0, FOLDER .. '/picture.png')";
        self.attempt(Permissions::all(), folder, code);
        assert!(folder.join("picture.png").exists());
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Runs a function's body, which knows `FOLDER`: `worked`, or why not.
    fn attempt(&self, permissions: Permissions, folder: &Path, code: &str) -> String {
        let lines = Lines::default();
        let options = Options {
            permissions,
            data_dir: Some(folder.join("data")),
            ..Options::default()
        };
        let mut simulator = Simulator::builder()
            .options(options)
            .console(Box::new(lines.clone()))
            .build();
        let script = format!(
            "local FOLDER <const> = {:?}
            local function route() {code} end
            function sysCall_nonSimulation()
                local ok, worked, reason = pcall(route)
                print('RESULT ' .. (ok and worked and 'worked' or tostring(not ok and worked or reason)))
            end",
            folder.to_str().expect("a plain name")
        );
        let added = simulator.add_script(ScriptKind::AddOn, "route", script.as_bytes());
        simulator.iterate();
        drop((added, simulator));
        let lines = lines.0.take();
        lines
            .iter()
            .find_map(|line| line.strip_prefix("RESULT "))
            .map_or_else(|| lines.join("\n"), str::to_owned)
    }
}

fn assert_refused(outcome: &str, option: &str, about: &str) {
    // A search for modules says what it has not found.
    let is_named = outcome.contains(&format!("is not allowed: run with {option}"))
        || option == "--allow-read" && outcome.contains("that may be read");
    assert!(is_named, "{about}: {outcome}");
}

fn assert_works(route: &Route, outcome: &str, about: &str) {
    let works = if route.needs_more {
        !outcome.contains("--allow-")
    } else {
        outcome == "worked"
    };
    assert!(works, "{} {about}: {outcome}", route.name);
}

#[test]
fn reading() {
    parallel::map(READS, |route| {
        let world = World::new();
        let (inside, outside) = (world.path("in"), world.path("out"));
        let refused = |permissions: Permissions, folder: &Path, about: &str| {
            let outcome = world.attempt(permissions, folder, route.code);
            assert_refused(&outcome, "--allow-read", &format!("{} {about}", route.name));
        };
        let allowed = Permissions::none().allow_read(&inside);
        refused(Permissions::none(), &outside, "without permission");
        refused(
            Permissions::strict().of_scene(&inside),
            &outside,
            "beside the scene",
        );
        refused(allowed.clone(), &inside.join("../out"), "by dots");
        #[cfg(unix)]
        refused(allowed.clone(), &inside.join("link"), "by a link");
        refused(
            Permissions::none()
                .allow_write_everywhere()
                .allow_run()
                .allow_net_everywhere(),
            &outside,
            "with others",
        );
        assert_works(
            route,
            &world.attempt(Permissions::all(), &outside, route.code),
            "with everything",
        );
        assert_works(
            route,
            &world.attempt(allowed, &inside.join("sub/.."), route.code),
            "in the folder",
        );
        assert_works(
            route,
            &world.attempt(
                Permissions::none().allow_read_everywhere(),
                &outside,
                route.code,
            ),
            "anywhere",
        );
    });
}

#[test]
fn writing() {
    parallel::map(WRITES, |route| {
        let world = World::new();
        let (inside, outside) = (world.path("in"), world.path("out"));
        let before = contents(&outside);
        let refused = |permissions: Permissions, folder: &Path, about: &str| {
            let outcome = world.attempt(permissions.allow_read_everywhere(), folder, route.code);
            assert_refused(
                &outcome,
                "--allow-write",
                &format!("{} {about}", route.name),
            );
            assert_eq!(contents(&outside), before, "{} {about}", route.name);
        };
        let allowed = Permissions::none().allow_write(&inside);
        refused(Permissions::none(), &outside, "without permission");
        refused(allowed.clone(), &inside.join("../out"), "by dots");
        #[cfg(unix)]
        refused(allowed.clone(), &inside.join("link"), "by a link");
        refused(
            Permissions::none()
                .allow_run()
                .allow_net_everywhere()
                .allow_native(),
            &outside,
            "with others",
        );
        let allowed = allowed.allow_read(&inside);
        assert_works(
            route,
            &world.attempt(allowed, &inside.join("sub/.."), route.code),
            "in the folder",
        );
        assert_works(
            route,
            &world.attempt(Permissions::all(), &outside, route.code),
            "with everything",
        );
    });
}

/// Every file with its bytes.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder)
        .expect("our own folder is readable")
        .flatten()
    {
        let bytes = fs::read(entry.path()).unwrap_or_default();
        all.push((entry.path(), bytes));
    }
    all.sort();
    all
}

#[test]
fn programs_and_native_code() {
    for (routes, option) in [(RUNS, "--allow-run"), (NATIVE, "--allow-native")] {
        for route in routes {
            let world = World::new();
            let folder = world.path("in");
            let others = Permissions::none()
                .allow_read_everywhere()
                .allow_write_everywhere()
                .allow_net_everywhere();
            let (others, enough) = match option {
                "--allow-run" => (others.clone().allow_native(), others.allow_run()),
                _ => (others.clone().allow_run(), others.allow_native()),
            };
            for permissions in [Permissions::none(), Permissions::strict(), others] {
                assert_refused(
                    &world.attempt(permissions, &folder, route.code),
                    option,
                    route.name,
                );
            }
            assert_works(
                route,
                &world.attempt(enough, &folder, route.code),
                "with the option",
            );
            assert_works(
                route,
                &world.attempt(Permissions::all(), &folder, route.code),
                "with everything",
            );
        }
    }
}

/// What is done to a listener of ours, or in its place.
#[test]
fn network() {
    let rule = |text: String| Permissions::none().allow_net(text.parse().expect("well-formed"));
    parallel::map(ADDRESSES, |route| {
        let others = Permissions::none()
            .allow_read_everywhere()
            .allow_write_everywhere()
            .allow_run()
            .allow_native();
        let elsewhere = |port: u16| {
            rule(format!("127.0.0.1:{}", port ^ 1))
                .allow_net("localhost".parse().expect("well-formed"))
        };
        for permissions in [Permissions::none(), Permissions::strict(), others] {
            assert_refused(
                &attempt_at_a_port(route, |_| permissions.clone()),
                "--allow-net",
                route.name,
            );
        }
        assert_refused(
            &attempt_at_a_port(route, elsewhere),
            "--allow-net",
            route.name,
        );
        let exact = |port: u16| rule(format!("127.0.0.1:{port}"));
        if route.is_vague {
            assert_refused(&attempt_at_a_port(route, exact), "--allow-net", route.name);
        } else {
            assert_works(
                route,
                &attempt_until_it_works(route, exact),
                "at that place",
            );
        }
        let anywhere = |_| Permissions::none().allow_net_everywhere();
        assert_works(
            route,
            &attempt_until_it_works(route, anywhere),
            "everywhere",
        );
    });
}

/// Takes a route at a port that the system chose, with the permissions for it.
fn attempt_at_a_port(route: &Route, permissions: impl Fn(u16) -> Permissions) -> String {
    let world = World::new();
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
    let port = listener.local_addr().expect("it listens").port();
    if route.listens {
        drop(listener);
    }
    world.attempt(
        permissions(port),
        &world.path("in"),
        &route.code.replace("PORT", &port.to_string()),
    )
}

/// The same, some times: another program may be given the port before the route listens there.
fn attempt_until_it_works(route: &Route, permissions: impl Fn(u16) -> Permissions) -> String {
    let more = if route.listens { 4 } else { 0 };
    let first = attempt_at_a_port(route, &permissions);
    (0..more).fold(first, |outcome, _| {
        if outcome == "worked" {
            outcome
        } else {
            attempt_at_a_port(route, &permissions)
        }
    })
}

/// Devices are read and written.
#[test]
fn devices() {
    let world = World::new();
    let folder = world.path("in");
    let code = "return require('sim').serialOpen(FOLDER .. '/victim', 9600) == -1";
    assert_refused(
        &world.attempt(Permissions::none().allow_read(&folder), &folder, code),
        "--allow-write",
        code,
    );
    assert_refused(
        &world.attempt(Permissions::none().allow_write(&folder), &folder, code),
        "--allow-read",
        code,
    );
    let both = Permissions::none().allow_read(&folder).allow_write(&folder);
    assert_eq!(world.attempt(both, &folder, code), "worked");
}

/// Files in the folder for temporary ones.
#[test]
fn temporary_files() {
    let world = World::new();
    let folder = world.path("in");
    for code in [
        "local file, why = io.tmpfile() return file and file:write('x') and file:close(), why",
        "return os.remove(os.tmpname())",
        "require('sim').systemSemaphore('swanilda test of permissions', true) return true",
    ] {
        let allowed = Permissions::none()
            .allow_write(&folder)
            .allow_read_everywhere();
        assert_refused(
            &world.attempt(allowed.clone(), &folder, code),
            "--allow-write",
            code,
        );
        assert_eq!(
            world.attempt(
                allowed
                    .allow_write(std::env::temp_dir())
                    .allow_write("/tmp"),
                &folder,
                code
            ),
            "worked"
        );
    }
}

/// The environment is read, not a file.
#[test]
fn environment() {
    let world = World::new();
    let folder = world.path("in");
    let code = "return os.getenv('PATH')";
    assert_refused(
        &world.attempt(Permissions::none().allow_read(&folder), &folder, code),
        "--allow-read",
        code,
    );
    assert_eq!(
        world.attempt(Permissions::none().allow_read_everywhere(), &folder, code),
        "worked"
    );
}

#[test]
fn certificates() {
    let world = World::new();
    let folder = world.path("in");
    let allowed = Permissions::none().allow_net_everywhere();
    assert_refused(
        &world.attempt(allowed.clone(), &folder, CERTIFICATES),
        "--allow-read",
        "certificates",
    );
    let outcome = world.attempt(allowed.allow_read(&folder), &folder, CERTIFICATES);
    assert!(outcome.contains("error loading certificate"), "{outcome}");
}

/// What would make other paths lead elsewhere, between the check of a path and its use.
#[test]
fn nothing_redirects_paths() {
    let world = World::new();
    let folder = world.path("in");
    let part = Permissions::none()
        .allow_read(&folder)
        .allow_write(&folder)
        .allow_run();
    for code in [
        "return require('lfs').chdir(FOLDER)",
        "return require('lfs').link(FOLDER, FOLDER .. '/new link', true)",
        "return require('lfs').link('../out', FOLDER .. '/new link', true)",
    ] {
        let outcome = world.attempt(part.clone(), &folder, code);
        assert_refused(&outcome, "--allow-read --allow-write", code);
    }
    assert!(!folder.join("new link").exists());
    let both = Permissions::none()
        .allow_read_everywhere()
        .allow_write_everywhere();
    let code = "return require('lfs').link('../out', FOLDER .. '/new link', true)";
    assert_eq!(world.attempt(both, &folder, code), "worked");
}

/// A file that a scene names may be a link, though its name lies in the scene's folder.
#[cfg(unix)]
#[test]
fn files_beside_a_scene() {
    let world = World::new();
    let folder = world.path("in");
    let allowed = Permissions::none().allow_read(&folder);
    let scene = folder.join("unpacked");
    fs::create_dir(&scene).expect("our own folder is writable");
    std::os::unix::fs::symlink(world.path("out/secret.lua"), scene.join("scene.json"))
        .expect("links can be made");
    let outcome = world.attempt(
        allowed.clone(),
        &folder,
        "return require('sim').loadScene(FOLDER .. '/unpacked')",
    );
    assert_refused(&outcome, "--allow-read", "an unpacked scene");
    let xml = "<CoppeliaSim><model/></CoppeliaSim>";
    fs::write(folder.join("side.simscene.xml"), xml).expect("our own folder is writable");
    let outcome = world.attempt(
        allowed,
        &folder,
        "return require('sim').loadScene(FOLDER .. '/side.simscene.xml')",
    );
    assert!(!outcome.contains("--allow-"), "{outcome}");
}

/// Data that outlive the program are files too: what is not allowed stays in memory, and the log says so.
#[test]
fn persistent_data() {
    let world = World::new();
    let folder = world.path("in");
    let code = "require('sim').persistentDataWrite('tag', 'value', 1) return true";
    assert_eq!(
        world.attempt(Permissions::strict().of_scene(&folder), &folder, code),
        "worked"
    );
    assert!(!folder.join("data").exists());
    let allowed = Permissions::none().allow_read(&folder).allow_write(&folder);
    assert_eq!(world.attempt(allowed, &folder, code), "worked");
    assert!(folder.join("data").exists());
}

/// The libraries of a script without restrictions are Lua's own: nothing stands in front of them.
#[test]
fn what_scripts_read_of_their_permissions() {
    let world = World::new();
    let folder = world.path("in");
    let code = "local sim = require 'sim'
        return sim.getBoolParam(sim.boolparam_execunsafe), tostring(sim.getBoolProperty(sim.handle_app, 'execUnsafeExt'))";
    assert_eq!(world.attempt(Permissions::all(), &folder, code), "worked");
    assert_eq!(
        world.attempt(Permissions::none().allow_run(), &folder, code),
        "worked"
    );
    assert_eq!(world.attempt(Permissions::strict(), &folder, code), "false");
}
