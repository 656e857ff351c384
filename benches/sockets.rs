//! How fast a script receives lines.

use std::io::Write;
use std::net::TcpListener;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const LINES: u64 = 100_000;

const READER: &[u8] = b"
socket = require 'socket'
function read(port, n)
    local client = assert(socket.connect('127.0.0.1', port))
    for _ = 1, n do assert(client:receive('*l')) end
    client:close()
end
";

/// Sends the lines to everybody who connects.
fn serve() -> u16 {
    let listener = TcpListener::bind(("127.0.0.1", 0)).expect("there is a free port");
    let port = listener.local_addr().expect("the listener is bound").port();
    let lines = b"0.125 0.250 0.500 1.000\n".repeat(LINES as usize);
    std::thread::spawn(move || {
        for mut client in listener.incoming().flatten() {
            // One that goes early has had enough.
            let _ = client.write_all(&lines);
        }
    });
    port
}

fn lines(criterion: &mut Criterion) {
    let port = serve();
    let mut sim = Simulator::new(Options::default());
    let reader = sim
        .add_script(ScriptKind::Customization, "reader", READER)
        .expect("the script loads");
    let mut group = criterion.benchmark_group("sockets");
    group.throughput(Throughput::Elements(LINES));
    group.sample_size(20);
    group.bench_function("receive('*l') of lines of 24 bytes", |bencher| {
        let args = [Data::Int(port.into()), Data::Int(LINES as i64)];
        bencher.iter(|| {
            sim.call(&reader, "read", &args)
                .expect("the function works")
        });
    });
    group.finish();
}

criterion_group!(benches, lines);
criterion_main!(benches);
