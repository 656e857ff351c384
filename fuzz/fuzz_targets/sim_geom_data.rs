//! Any bytes as the data of a mesh, an octree and a point cloud: a structure that can be queried and stored again, or an error.
//!
//! `cargo fuzz run sim_geom_data`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let code = b"
        simGeom = require 'simGeom'
        local zero, unit = {0, 0, 0}, {0, 0, 0, 1}
        function read(bytes)
            for _, kind in ipairs{'Mesh', 'Octree', 'Ptcloud'} do
                local ok, handle = pcall(simGeom['create' .. kind .. 'FromSerializationData'], bytes)
                if ok then
                    local again = simGeom['create' .. kind .. 'FromSerializationData'](simGeom['get' .. kind .. 'SerializationData'](handle))
                    assert(simGeom['get' .. kind .. 'PointDistance'](handle, zero, unit, zero) == simGeom['get' .. kind .. 'PointDistance'](again, zero, unit, zero))
                    if kind ~= 'Ptcloud' then simGeom['get' .. kind .. kind .. 'Collision'](handle, zero, unit, again, {0.1, 0, 0}, unit) end
                end
            end
            return true
        end";
    let script = sim.add_script(ScriptKind::Customization, "fuzz", code).expect("the script loads");
    let results = sim.call(&script, "read", &[Data::Buffer(bytes.to_vec())]).expect("what was read can be stored and queried");
    assert!(matches!(results.first(), Some(Data::Bool(true))));
});
