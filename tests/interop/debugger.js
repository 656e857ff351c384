// The client that Microsoft tests debug adapters with, against `swanilda debug`. Arguments: the command, a script with known lines.

const assert = require('node:assert');
const { DebugClient } = require('@vscode/debugadapter-testsupport');

const [command, program] = process.argv.slice(2);

async function variables(client, frameId, name) {
    const { scopes } = (await client.scopesRequest({ frameId })).body;
    const scope = scopes.find((scope) => scope.name === name);
    const { variables } = (await client.variablesRequest({ variablesReference: scope.variablesReference })).body;
    return variables;
}

async function main() {
    const client = new DebugClient(command, 'debug', 'swanilda');
    client.defaultTimeout = 60_000;
    await client.start();
    // Introduces itself, launches, sets the breakpoint, and checks reason, line and file of the stop.
    await client.hitBreakpoint({ program, time: 0.5 }, { path: program, line: 6 });
    const threadId = (await client.threadsRequest()).body.threads.find((thread) => thread.name === '/Script').id;
    const [frame, caller] = (await client.stackTraceRequest({ threadId })).body.stackFrames;
    assert.deepStrictEqual([frame.name, caller.name], ['add', 'sysCall_init']);
    const locals = await variables(client, frame.id, 'Locals');
    assert.deepStrictEqual(locals.map(({ name, value, type }) => [name, value, type]), [['n', '1', 'number']]);
    const objects = await variables(client, frame.id, 'Objects');
    assert.ok(objects.some((object) => object.name === '/Floor'));
    const sum = await client.evaluateRequest({ expression: 'count + n', frameId: frame.id, context: 'watch' });
    assert.strictEqual(sum.body.result, '1');
    await Promise.all([
        client.nextRequest({ threadId }),
        client.assertStoppedLocation('step', { path: program, line: 7 }),
    ]);
    await client.setBreakpointsRequest({ source: { path: program }, breakpoints: [{ line: 26, condition: 'count > 20' }] });
    await Promise.all([
        client.continueRequest({ threadId }),
        client.assertStoppedLocation('breakpoint', { path: program, line: 26 }),
    ]);
    await Promise.all([
        client.stepInRequest({ threadId }),
        client.assertStoppedLocation('step', { path: program, line: 6 }),
    ]);
    await client.setBreakpointsRequest({ source: { path: program }, breakpoints: [] });
    await Promise.all([client.continueRequest({ threadId }), client.waitForEvent('terminated')]);
    await client.stop();
    console.log('done');
}

main().catch((error) => {
    console.log(error);
    process.exit(1);
});
