"""The MCP server of others for CoppeliaSim, coppeliasim-mcp, above `swanilda serve` at a port: its tools find a simulator."""

import asyncio
import os
import sys

from mcp import ClientSession, StdioServerParameters
from mcp.client.stdio import stdio_client


async def main(port):
    environment = dict(os.environ, COPPELIA_HOST='localhost', COPPELIA_PUERTO=port)
    server = StdioServerParameters(command=sys.executable, args=['-m', 'coppeliasim_mcp.server'], env=environment)
    async with stdio_client(server) as streams, ClientSession(streams[0], streams[1]) as session:
        await session.initialize()

        async def call(tool, **arguments):
            result = await session.call_tool(tool, arguments)
            assert not result.is_error, result
            return result.content[0].text

        made = await call('crear_primitiva', forma='cubo', alias='Caja', z=1)
        assert 'Caja' in made, made
        assert 'Caja' in await call('listar_objetos')
        await call('fijar_posicion', nombre='Caja', x=0.5, y=0, z=1)
        assert '0.5' in await call('obtener_posicion', nombre='Caja')
        await call('iniciar_simulacion')
        stepped = await call('paso_simulacion', pasos=3)
        assert 'Avanzados 3 pasos' in stepped, stepped
        assert await call('estado_simulacion')
        await call('detener_simulacion')


asyncio.run(main(sys.argv[1]))
