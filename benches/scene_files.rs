//! How fast scenes are read: the compression alone, and the whole way into a scene.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use swanilda::scene::Scene;
use swanilda::{Options, SceneFile, ScriptKind, Simulator};

/// So many meshes of 50 x 50 uneven points, each on a joint; no two are equal.
const MESHES: &str = "
sim = require 'sim'
local n = 50
local indices = {}
for y = 0, n - 2 do
    for x = 0, n - 2 do
        local i = y * n + x
        for _, at in ipairs{i, i + 1, i + n, i + 1, i + n + 1, i + n} do indices[#indices + 1] = at end
    end
end
for count = 1, COUNT do
    local vertices = {}
    for i = 0, n * n - 1 do
        local x, y = i % n / n, i // n / n
        local z = 0.1 * math.sin(7 * x + count) + 0.02 * math.cos(31 * y * x + count)
        table.move({x + 0.01 * z, y, z}, 1, 3, #vertices + 1, vertices)
    end
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectParent(sim.createShape(0, 0.5, vertices, indices, nil, nil, nil, nil), joint, true)
end
";

/// A file of about `megabytes`.
fn scene_file(megabytes: usize) -> Vec<u8> {
    let file = |meshes: usize| {
        let mut sim = Simulator::new(Options::default());
        let text = MESHES.replace("COUNT", &meshes.to_string());
        sim.add_script(ScriptKind::Customization, "meshes", text.as_bytes())
            .expect("the script runs");
        assert_eq!(sim.errors(), 0);
        SceneFile::bytes_of(&sim.scene(), &[]).expect("the tree is sound")
    };
    let each = (file(3).len() - file(1).len()) / 2;
    file((megabytes * 1_000_000).div_ceil(each))
}

fn decompression(c: &mut Criterion) {
    let bytes = scene_file(1);
    let body = SceneFile::body(&bytes).expect("the saver writes what can be read");
    let mut group = c.benchmark_group("decompression");
    group.throughput(Throughput::Bytes(body.len() as u64));
    group.bench_function("scene of 1 MB", |b| b.iter(|| SceneFile::body(&bytes)));
    group.finish();
}

fn loading(c: &mut Criterion) {
    let mut group = c.benchmark_group("loading");
    for megabytes in [1, 4] {
        let bytes = scene_file(megabytes);
        group.throughput(Throughput::Bytes(bytes.len() as u64));
        group.sample_size(20);
        group.bench_function(format!("scene of {megabytes} MB"), |b| {
            b.iter(|| {
                let file = SceneFile::read(&bytes).expect("the saver writes what can be read");
                let mut scene = Scene::new();
                file.add_to(&mut scene, true).expect("there is room");
                scene
            });
        });
    }
    group.finish();
}

criterion_group!(benches, decompression, loading);
criterion_main!(benches);
