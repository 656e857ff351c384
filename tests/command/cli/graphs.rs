//! `swanilda run --graph`.

use super::{Scene, stderr};

const GRAPH: &str = "sim = require 'sim'
local xml = [[<CoppeliaSim><filetype>simpleModel</filetype><xmlSerializationNb>2</xmlSerializationNb>
<graph><common><alias>Graph</alias></common></graph></CoppeliaSim>]]
function sysCall_init()
    graph = sim.loadModel(sim.packUInt8Table({xml:byte(1, -1)}))
    height = sim.addGraphStream(graph, 'height', 'm', 0, {1, 0, 0}, 0)
end
function sysCall_sensing()
    sim.setGraphStreamValue(graph, height, 2 * sim.getSimulationTime())
    sim.handleGraph(graph, sim.getSimulationTime())
end";

#[test]
fn graphs_become_tables_and_pictures() {
    let scene = Scene::new(GRAPH);
    let file = |name: &str| scene.folder.path().join(name).display().to_string();
    let (table, picture) = (
        format!("/Graph={}", file("g.csv")),
        format!("Graph={}", file("g.svg")),
    );
    let output = scene.run(&[
        "--steps", "4", "--quiet", "--graph", &table, "--graph", &picture,
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = std::fs::read_to_string(file("g.csv")).expect("it was written");
    assert!(
        text.starts_with("time [s],height [m]\n0,0\n0.05,0.1\n0.1,0.2\n"),
        "{text}"
    );
    let text = std::fs::read_to_string(file("g.svg")).expect("it was written");
    assert!(
        text.starts_with("<svg") && text.contains("height [m]") && text.contains("/Graph"),
        "{text}"
    );
}

#[test]
fn graphs_that_are_not_there_are_errors() {
    let scene = Scene::new(GRAPH);
    for (graph, reason) in [
        ("/Nobody=g.svg", "there is no graph /Nobody"),
        ("/Floor=g.svg", "there is no graph /Floor"),
        ("/Graph=g.png", "graphs become .svg or .csv files, not .png"),
        ("/Graph", "PATH=FILE is needed"),
        ("=g.svg", "PATH=FILE is needed"),
        ("/Graph=/no/such/g.svg", "cannot write /no/such/g.svg: "),
    ] {
        let output = scene.run(&["--steps", "1", "--quiet", "--graph", graph]);
        assert_eq!(output.status.code(), Some(2), "{graph}");
        assert!(
            stderr(&output).contains(reason),
            "{graph}: {}",
            stderr(&output)
        );
    }
}
