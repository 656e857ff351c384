//! How fast scripts talk: a broadcast of a small table to 100 scripts.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const RECEIVERS: u64 = 100;
const MESSAGES: u64 = 1000;

const RECEIVER: &[u8] = b"function sysCall_msg(message, origin) last = message.data end";
const SENDER: &[u8] = b"
sim = require 'sim'
function send(n) local m = {id = 'pose', data = {1, 2, 3}} for _ = 1, n do sim.broadcastMsg(m) end end
";

fn broadcast(criterion: &mut Criterion) {
    let mut sim = Simulator::new(Options::default());
    for _ in 0..RECEIVERS {
        sim.add_script(ScriptKind::Customization, "receiver", RECEIVER)
            .expect("the script loads");
    }
    let sender = sim
        .add_script(ScriptKind::Customization, "sender", SENDER)
        .expect("the script loads");
    let mut group = criterion.benchmark_group("messages");
    group.throughput(Throughput::Elements(RECEIVERS * MESSAGES));
    group.bench_function("broadcast to 100 scripts", |bencher| {
        bencher.iter(|| {
            sim.call(&sender, "send", &[Data::Int(MESSAGES as i64)])
                .expect("the function works")
        });
    });
    group.finish();
}

criterion_group!(benches, broadcast);
criterion_main!(benches);
