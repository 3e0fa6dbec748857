import { defineConfig } from 'vitest/config';

export default defineConfig({
  // Relative addresses: the page is served from any folder, by any server.
  base: './',
  worker: { format: 'es' },
  build: {
    target: 'es2022',
    chunkSizeWarningLimit: 900,
    assetsInlineLimit: 0,
    rolldownOptions: { input: ['index.html', 'museum.html'] },
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
        test: { name: 'speed', include: ['tests/speed/*.speed.ts'], environment: 'node', testTimeout: 60_000 },
      },
    ],
  },
});
