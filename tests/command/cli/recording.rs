//! `swanilda run --record` and `swanilda export`.

use std::path::PathBuf;
use std::process::Output;

use test_support::process::output_of;

use super::{Scene, stderr, swanilda};

const SCENE: &str = "sim = require 'sim'
local xml = [[<CoppeliaSim><filetype>simpleModel</filetype><xmlSerializationNb>2</xmlSerializationNb>
<graph><common><alias>Graph</alias></common></graph></CoppeliaSim>]]
function sysCall_init()
    graph = sim.loadModel(sim.packUInt8Table({xml:byte(1, -1)}))
    height = sim.addGraphStream(graph, 'height', 'm', 0, {1, 0, 0}, 0)
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2})
    sim.setObjectAlias(ball, 'Ball <1>')
    sim.setObjectPosition(ball, {0, 0, 0.3})
    sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(ball, sim.shapeintparam_respondable, 1)
end
function sysCall_sensing()
    local t = sim.getSimulationTime()
    print('at', t)
    sim.setGraphStreamValue(graph, height, sim.getObjectPosition(ball)[3])
    sim.handleGraph(graph, t)
    if t > 1 then sim.setInt32Signal('late', 1) end
end";

fn file(scene: &Scene, name: &str) -> PathBuf {
    scene.folder.path().join(name)
}

fn run(scene: &Scene, args: &[&str]) -> Output {
    let mut command = swanilda();
    command
        .arg("run")
        .arg(scene.path())
        .arg("--quiet")
        .args(args)
        .current_dir(scene.folder.path());
    output_of(&mut command)
}

fn export(scene: &Scene, args: &[&str]) -> Output {
    let mut command = swanilda();
    output_of(
        command
            .arg("export")
            .args(args)
            .current_dir(scene.folder.path()),
    )
}

/// The index in a page that plays a recording.
fn index_of(page: &str) -> serde_json::Value {
    let (_, rest) = page
        .split_once("id=\"recording\">")
        .expect("there is an index");
    serde_json::from_str(rest.split_once("</script>").expect("it ends").0).expect("it is JSON")
}

#[test]
fn a_run_is_recorded_and_exported() {
    let scene = Scene::new(SCENE);
    let output = run(&scene, &["--steps", "40", "--record", "a.swr"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let args = [
        "a.swr", "--html", "a.html", "--mcap", "a.mcap", "--graph", "Graph", "-o", "g.csv",
    ];
    let output = export(&scene, &args);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = std::fs::read_to_string(file(&scene, "a.html")).expect("it was written");
    let index = index_of(&page);
    assert_eq!(
        (&index["name"], &index["timeStep"]),
        (&"scene.lua".into(), &0.05.into())
    );
    assert_eq!(
        index["chunks"].as_array().map(Vec::len),
        Some(page.matches("octet-stream\" data-chunk=").count())
    );
    let kinds: Vec<&str> = index["marks"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|m| m["kind"].as_str())
        .collect();
    assert!(
        kinds.contains(&"contact") && kinds.contains(&"signal"),
        "{kinds:?}"
    );
    assert!(!page.contains("\nimport ") && !page.contains("\nexport "));
    let mcap = std::fs::read(file(&scene, "a.mcap")).expect("it was written");
    assert!(mcap.starts_with(b"\x89MCAP0\r\n") && mcap.ends_with(b"\x89MCAP0\r\n"));
    let table = std::fs::read_to_string(file(&scene, "g.csv")).expect("it was written");
    assert!(
        table.starts_with("time [s],height [m]\n0,") && table.lines().count() > 40,
        "{table}"
    );
}

#[test]
fn the_same_run_is_the_same_recording() {
    let scene = Scene::new(SCENE);
    let [one, other] = ["a.swr", "b.swr"].map(|name| {
        assert_eq!(
            run(&scene, &["--steps", "30", "--record", name])
                .status
                .code(),
            Some(0)
        );
        std::fs::read(file(&scene, name)).expect("it was written")
    });
    assert!(one == other);
}

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_a_recording() {
    let code = "function sysCall_actuation() if sim.getSimulationTime() > 2.5 then os.execute('kill -9 $PPID') end end";
    let scene = Scene::new(&format!("{SCENE}\n{code}"));
    run(&scene, &["--record", "a.swr"]);
    let output = export(&scene, &["a.swr", "--html", "a.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let index = index_of(&std::fs::read_to_string(file(&scene, "a.html")).expect("it was written"));
    let end = index["end"].as_f64().expect("a number");
    assert!(end > 1.5 && end < 2.5, "{end}");
    let output = export(&scene, &["a.swr", "--graph", "/Graph", "-o", "g.svg"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("there are no graphs in this recording"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn errors_are_marked() {
    let scene = Scene::new(&format!(
        "{SCENE}\nfunction sysCall_actuation() if sim.getSimulationTime() > 1 then error('oh') end end"
    ));
    assert_eq!(
        run(&scene, &["--steps", "40", "--record", "a.swr"])
            .status
            .code(),
        Some(1)
    );
    assert_eq!(
        export(&scene, &["a.swr", "--html", "a.html"]).status.code(),
        Some(0)
    );
    let index = index_of(&std::fs::read_to_string(file(&scene, "a.html")).expect("it was written"));
    let error = index["marks"]
        .as_array()
        .expect("a list")
        .iter()
        .find(|mark| mark["kind"] == "error");
    let error = error.expect("it is marked");
    assert!(
        error["text"]
            .as_str()
            .is_some_and(|text| text.contains("oh"))
            && error["handle"].is_i64(),
        "{error}"
    );
}

#[test]
fn what_cannot_be_recorded_or_exported_is_an_error() {
    let scene = Scene::new(SCENE);
    let output = run(&scene, &["--steps", "1", "--record", "no/such/a.swr"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("cannot write no/such/a.swr: "),
        "{}",
        stderr(&output)
    );
    assert_eq!(
        run(&scene, &["--steps", "1", "--record", "a.swr"])
            .status
            .code(),
        Some(0)
    );
    for (args, reason) in [
        (
            &["scene.lua", "--html", "a.html"][..],
            "cannot read scene.lua: it is not a recording of Swanilda",
        ),
        (&["none.swr", "--html", "a.html"], "cannot read none.swr: "),
        (&["a.swr"], "required arguments"),
        (
            &["a.swr", "--html", "no/such/a.html"],
            "cannot write no/such/a.html: ",
        ),
        (&["a.swr", "--graph", "/Graph"], "--output"),
        (
            &["a.swr", "--graph", "/Other", "-o", "g.svg"],
            "there is no graph /Other: there are /Graph",
        ),
        (
            &["a.swr", "--graph", "/Graph", "-o", "g.png"],
            "graphs become .svg or .csv files, not .png",
        ),
    ] {
        let output = export(&scene, args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            stderr(&output).contains(reason),
            "{args:?}: {}",
            stderr(&output)
        );
    }
}
