import { defineConfig } from 'vitest/config';
import { compressedFiles } from './compressed-files.ts';
import { keptEngines } from './kept-engines.ts';
import { SERVICE_WORKER, serviceWorkerFiles } from './service-worker-files.ts';

export default defineConfig({
  // Relative addresses: the page is served from any folder, by any server.
  base: './',
  plugins: [
    keptEngines(new URL('engines', import.meta.url).pathname),
    serviceWorkerFiles(new URL('public', import.meta.url).pathname),
    compressedFiles(new URL('dist', import.meta.url).pathname),
  ],
  worker: { format: 'es' },
  build: {
    target: 'es2022',
    chunkSizeWarningLimit: 900,
    assetsInlineLimit: 0,
    rolldownOptions: {
      input: {
        index: 'index.html',
        museum: 'museum.html',
        'service-worker': 'src/offline/service-worker.ts',
      },
      output: {
        entryFileNames: ({ name }) => (name === 'service-worker' ? SERVICE_WORKER : 'assets/[name]-[hash].js'),
      },
    },
  },
  server: { host: '127.0.0.1' },
  preview: { host: '127.0.0.1' },
  test: {
    projects: [
      { extends: true, test: { name: 'unit', include: ['tests/unit/*.test.ts'], environment: 'node' } },
      {
        extends: true,
        // One browser at a time: drawing in software takes the cores that the physics needs.
        test: {
          name: 'page',
          include: ['tests/page/*.test.ts'],
          environment: 'node',
          fileParallelism: false,
          // A busy machine may be ten times as slow.
          testTimeout: 600_000,
          hookTimeout: 120_000,
        },
      },
      {
        extends: true,
        // One file at a time: two browsers would measure each other.
        test: {
          name: 'speed',
          include: ['tests/speed/*.speed.ts'],
          environment: 'node',
          fileParallelism: false,
          testTimeout: 60_000,
        },
      },
    ],
  },
});
