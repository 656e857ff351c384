//! Servers that scripts start, and several clients.

use std::net::{SocketAddr, TcpListener};
use std::time::Duration;

use test_support::process::wait_until;

use super::simx::{BLOCKING, Client, Server, command, ints, read_ints, text};

/// Starts a server at a port that is stored in an integer signal.
const SCENE: &str = "
    sim = require 'sim'
    simRemoteApi = require 'simRemoteApi'
    function start(ints) return {simRemoteApi.start(ints[1], 1300, false, true)}, {}, {}, '' end
    function stop(ints) return {simRemoteApi.stop(ints[1])}, {}, {}, '' end
    function reset(ints) return {simRemoteApi.reset(ints[1])}, {}, {}, '' end
    function status(ints)
        local status, info, server, client, ip = simRemoteApi.status(ints[1])
        return {status, server, client, info and #info or -1}, {}, {tostring(ip)}, ''
    end
";

/// Calls a function of the script with the port as its argument: the integers and the first text it returns.
fn script(client: &mut Client, function: &str, port: u16) -> (Vec<i32>, String) {
    let script = client.handle("/Script");
    let key = [&script[..], &[0], &text(function)].concat();
    let data = client.get(0x3401, &key, &ints(&[1, 0, 0, 0, port.into()]));
    let counts = read_ints(&data[..16]);
    let (numbers, texts) = data[16..].split_at(4 * counts[0] as usize);
    let name = texts.split(|&byte| byte == 0).next().unwrap_or_default();
    (
        read_ints(numbers),
        String::from_utf8_lossy(name).into_owned(),
    )
}

fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
    listener.local_addr().expect("it is bound").port()
}

fn at(port: u16) -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], port))
}

#[test]
fn scripts_start_and_stop_servers() {
    let server = Server::start(SCENE);
    let (mut client, port) = (server.connect(), free_port());
    assert_eq!(script(&mut client, "status", port).0, [-1, 11, -1, -1]);
    assert_eq!(script(&mut client, "start", port).0, [1]);
    assert_eq!(
        script(&mut client, "start", port).0,
        [-1],
        "the port is taken"
    );
    assert_eq!(
        script(&mut client, "status", port),
        (
            vec![1, 11, -1, 5],
            "NONE (reception line is not open)".into()
        )
    );
    let mut second = Client::connect(at(port));
    second.handle("/Floor");
    assert_eq!(
        script(&mut client, "status", port),
        (vec![3, 11, 11, 5], "127.0.0.1".into())
    );
    assert_eq!(script(&mut client, "reset", port).0, [1]);
    assert!(
        second.exchange_bytes(&[]).is_err(),
        "its connection is closed"
    );
    Client::connect(at(port)).handle("/Floor");
    assert_eq!(script(&mut client, "stop", port).0, [1]);
    assert_eq!(script(&mut client, "stop", port).0, [-1]);
    assert!(std::net::TcpStream::connect(at(port)).is_err());
}

#[test]
fn servers_of_the_command_line_stay() {
    let server = Server::start(SCENE);
    let mut client = server.connect();
    assert_eq!(script(&mut client, "stop", server.address.port()).0, [-1]);
}

#[test]
fn servers_of_simulation_scripts_end_with_the_simulation() {
    let server = Server::start(
        "sim = require 'sim'
        function add(ints)
            local code = ('simRemoteApi = require \"simRemoteApi\" function sysCall_init() simRemoteApi.start(%d) end'):format(ints[1])
            sim.createScript(sim.scripttype_simulation, code, 0, 'lua')
            return {}, {}, {}, ''
        end",
    );
    let (mut client, port) = (server.connect(), free_port());
    script(&mut client, "add", port);
    client.get(0x1007, &ints(&[0]), &[]);
    client.get(0x0001, &[], &[]);
    wait_until("the server starts", || {
        client.call(command(0x0003, BLOCKING, &[], &[]));
        std::net::TcpStream::connect(at(port)).is_ok()
    });
    let mut theirs = Client::connect(at(port));
    theirs.exchange(&[]);
    assert!(
        theirs.fails(0x0001, &[], &[]),
        "the synchronous mode was not enabled"
    );
    client.get(0x1007, &ints(&[2]), &[]);
    let asked = command(0x1021, BLOCKING, &ints(&[1]), &[]);
    wait_until("the simulation stops", || {
        client.exchange(std::slice::from_ref(&asked)).state == 0
    });
    assert!(std::net::TcpStream::connect(at(port)).is_err());
}

#[test]
fn all_synchronous_clients_must_trigger() {
    let server = Server::start(SCENE);
    let (mut first, port) = (server.connect(), free_port());
    script(&mut first, "start", port);
    let mut second = Client::connect(at(port));
    let time = |client: &mut Client| {
        client
            .call(command(0x1021, BLOCKING, &ints(&[1]), &[]))
            .time
    };
    first.get(0x0001, &[], &[]);
    second.get(0x0001, &[], &[]);
    first.get(0x1007, &ints(&[0]), &[]);
    first.get(0x0003, &[], &[]);
    std::thread::sleep(Duration::from_millis(20));
    assert_eq!((time(&mut first), time(&mut second)), (0, 0));
    second.get(0x0003, &[], &[]);
    assert_eq!((time(&mut second), time(&mut first)), (50, 50));
}

#[test]
fn a_second_client_waits_until_the_first_is_gone() {
    let server = Server::start(SCENE);
    let mut first = server.connect();
    first.handle("/Floor");
    let address = server.address;
    let second = std::thread::spawn(move || Client::connect(address).handle("/Floor"));
    std::thread::sleep(Duration::from_millis(50));
    assert!(!second.is_finished());
    // As simxFinish does: the server replies, then it closes.
    first.exchange(&[command(0x000a, 0, &[], &[0; 4])]);
    second.join().expect("it is served");
    assert!(first.exchange_bytes(&[]).is_err());
}
