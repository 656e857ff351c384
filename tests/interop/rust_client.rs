//! The Rust client of others: a typed client, which asks for the end when it is dropped.

use coppeliasim_zmq_remote_api::sim::Sim;
use coppeliasim_zmq_remote_api::{RemoteApiClient, RemoteApiClientParams, sim};

use crate::server::Server;

fn client(server: &Server) -> RemoteApiClient {
    let rpc_port = server.port.parse().expect("a port is a number");
    let params = RemoteApiClientParams {
        rpc_port,
        ..RemoteApiClientParams::default()
    };
    RemoteApiClient::new(params).expect("the server listens")
}

#[test]
fn values_callbacks_and_steps() {
    let server = Server::start();
    let mut client = client(&server);
    let floor = client
        .sim_get_object("/Floor".to_owned(), None)
        .expect("the default scene has a floor");
    let dummy = client.sim_create_dummy(0.1).expect("a dummy");
    client
        .sim_set_object_position(dummy, vec![1.0, 2.5, -3.0], Some(sim::HANDLE_WORLD))
        .expect("a position");
    let position = client
        .sim_get_object_position(dummy, Some(floor))
        .expect("its position");
    assert_eq!(position.len(), 3);
    assert!(client.sim_get_object("/nobody".to_owned(), None).is_err());
    client.register_callback("sum".to_owned(), Box::new(|_| serde_json::json!([30])));
    client
        .sim_test_cb(10, "sum@func".to_owned(), 20)
        .expect("callbacks");
    client.sim_set_stepping(true).expect("stepping");
    client.sim_start_simulation().expect("a start");
    while client.sim_get_simulation_time().expect("the time") < 0.5 - 1e-9 {
        client.sim_step().expect("a step");
    }
    client.sim_stop_simulation(Some(true)).expect("the end");
    assert_eq!(
        client.sim_get_simulation_state().expect("the state"),
        sim::SIMULATION_STOPPED
    );
}

#[test]
fn one_that_is_dropped_does_not_hold_up_the_other() {
    let server = Server::start();
    let (first, second) = (client(&server), client(&server));
    for client in [&first, &second] {
        client.sim_set_stepping(true).expect("stepping");
    }
    first.sim_start_simulation().expect("a start");
    drop(first);
    for _ in 0..3 {
        second.sim_step().expect("a step");
    }
    assert!(second.sim_get_simulation_time().expect("the time") > 0.0);
}
