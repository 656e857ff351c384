"""Several calls of the ZeroMQ remote API in one round trip.

Works on the connection of CoppeliaSim's official client (`coppeliasim-zmqremoteapi-client`); the server must be Swanilda.

    from coppeliasim_zmqremoteapi_client import RemoteAPIClient
    from swanilda_batch import Batch

    client = RemoteAPIClient()
    with Batch(client) as batch:
        position = batch.sim.getObjectPosition(handle)
        batch.sim.setJointTargetPosition(joint, 0.5)
        batch.sim.step()
        time = batch.sim.getSimulationTime()
    print(position.value, time.value)

The calls are made in order when the `with` block ends, as if they came one by one: they may wait for a step and call back.
A call that fails does not keep the others from being made, unless `stop_at_error` is set; `value` of its result raises its error.
"""


class CallError(Exception):
    """A call of a batch failed, or was not made because one before it had failed."""


class Result:
    """What a call of a batch returned; known when the batch has run."""

    def __init__(self, name):
        self.name = name
        self._reply = None

    @property
    def value(self):
        """None, the value, or a tuple of several, as the official client gives them."""
        if self._reply is None:
            raise CallError(f"{self.name}: not called")
        if "err" in self._reply:
            raise CallError(self._reply["err"])
        values = list(self._reply["ret"])
        return values[0] if len(values) == 1 else tuple(values) or None


class _Namespace:
    """`sim` and its like: what is called on it is noted."""

    def __init__(self, batch, name):
        self._batch, self._name = batch, name

    def __getattr__(self, member):
        return lambda *args: self._batch.call(f"{self._name}.{member}", *args)


class Batch:
    """Calls that are noted until `run`, which a `with` block calls at its end.

    `batch.sim.getObject('/Floor')` notes a call, and so does any other namespace the server knows. Callables as arguments are not
    for batches. At most 10000 calls fit.
    """

    def __init__(self, client, stop_at_error=False):
        self._client, self._stop_at_error = client, stop_at_error
        self._calls, self._results = [], []

    def __getattr__(self, namespace):
        if namespace.startswith("_"):
            raise AttributeError(namespace)
        return _Namespace(self, namespace)

    def __enter__(self):
        return self

    def __exit__(self, error_type, error, traceback):
        if error_type is None:
            self.run()

    def call(self, name, *args):
        """Notes a call of a function by its full name."""
        self._calls.append({"func": name, "args": list(args), "argsL": len(args)})
        self._results.append(Result(name))
        return self._results[-1]

    def run(self):
        """Makes the calls noted so far; gives their results."""
        calls, results = self._calls, self._results
        self._calls, self._results = [], []
        if calls:
            replies = self._client.call("swanilda.batch", [calls, self._stop_at_error])
            for result, reply in zip(results, replies):
                result._reply = reply
        return results
